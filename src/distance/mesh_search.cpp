#include "mesh_search.h"

#include <algorithm>
#include <functional>

namespace deformable_manipulation {
namespace distance {
namespace {

constexpr double kSlack = 1e-9;  // m, of bounds that earlier results give: far more than rounding
constexpr double kLevel = 1e-9;  // m, differences of distance below it count as none

}  // namespace

void MeshSearch::start(const ObjectTree& object) {
  object_ = &object;
  const std::size_t points = object.pointCount();
  if (samples_.size() != points) {
    samples_.assign(points, SurfacePoint());
    sampled_.assign(points, round_);
  }
  ++round_;
}

const SurfacePoint& MeshSearch::cornerSample(int point, int hint) {
  if (sampled_[point] != round_) {
    const int last = samples_[point].triangle;
    samples_[point] = surface_.nearest(object_->point(point), last >= 0 ? last : hint);
    sampled_[point] = round_;
  }
  return samples_[point];
}

MeshPlace MeshSearch::placeAt(int element, const Weights& weights, double distance, int triangle) const {
  return {distance, triangle, element, object_->element(element), weights};
}

MeshPlace MeshSearch::minimum(const ObjectTree& object, double bound, const MeshPlace& guess) {
  start(object);
  const double known_depth = std::max(0.0, -bound);
  double upper = bound;
  if (guess.known()) {
    const Vector3 point = weighted<3>(object.corners<3>(guess.element), guess.weights);
    const SurfacePoint there = surface_.nearest(point, guess.triangle);
    if (there.distance < 0.0) {
      const MeshPlace deep = deepest(known_depth);
      if (deep.known() || known_depth > 0.0) {
        return deep;
      }
    }
    upper = std::min(upper, there.distance);
  }
  upper = std::max(upper, 0.0) + kSlack;
  const Nearest found = nearestPair(0, upper * upper);
  if (found.element < 0) {
    return pieceInside(-1) ? deepest(known_depth) : MeshPlace();
  }
  const MeshPlace place = placeAt(found.element, found.at.weights, std::sqrt(found.at.squared), found.triangle);
  if (!surface_.closed()) {
    return place;
  }
  const bool touches = found.at.squared == 0.0;
  const Vector3 point = weighted<3>(object.corners<3>(place.element), place.weights);
  if (touches || surface_.nearest(point, place.triangle).distance < 0.0 ||
      pieceInside(object.pieceOf(place.vertices[0]))) {
    const MeshPlace deep = deepest(known_depth);
    return deep.known() ? deep : place;
  }
  return place;
}

MeshSearch::Nearest MeshSearch::nearestPair(int object_root, double squared_bound) {
  Nearest nearest;
  nearest.at.squared = squared_bound;
  if (object_->surface()) {
    search<3>(object_root, &nearest);
  } else {
    search<2>(object_root, &nearest);
  }
  return nearest;
}

template <int K>
void MeshSearch::search(int object_root, Nearest* nearest) {
  stack_.push(0.0F, {object_root, 0});
  while (!stack_.empty()) {
    const auto entry = stack_.pop();
    if (entry.bound >= nearest->at.squared) {
      continue;
    }
    const Pair pair = entry.what;
    if (pair.object >= 0 || pair.surface >= 0) {
      expand<K>(pair, nearest->at.squared);
      continue;
    }
    const Corners<K> element = object_->corners<K>(~pair.object);
    const Corners<3> triangle = surface_.corners(~pair.surface);
    if (ElementDistance<K>(element, triangle).improve(&nearest->at)) {
      nearest->element = ~pair.object;
      nearest->triangle = ~pair.surface;
    }
  }
}

//! Pushes the pairs of one's children with the other; of two nodes the larger one is opened.
template <int K>
void MeshSearch::expand(const Pair& pair, double limit) {
  if (pair.object < 0) {
    expandSurface(pair, boundsOf<K>(~pair.object, pair.surface, limit), limit);
    return;
  }
  const BoxNode& of_object = object_->tree()[pair.object];
  if (pair.surface >= 0 && surface_.tree()[pair.surface].box.extent() >= of_object.box.extent()) {
    expandSurface(pair, surface_.tree()[pair.surface].squaredDistances(of_object.box), limit);
    return;
  }
  const Box of_surface = pair.surface < 0 ? surface_.boxOf(~pair.surface) : surface_.tree()[pair.surface].box;
  const NearChildren near(of_object, of_object.squaredDistances(of_surface), limit);
  for (int i = 0; i < near.count(); ++i) {
    stack_.push(near.bound(i), {near.child(i), pair.surface});
  }
}

void MeshSearch::expandSurface(const Pair& pair, const FourFloats& bounds, double limit) {
  const NearChildren near(surface_.tree()[pair.surface], bounds, limit);
  for (int i = 0; i < near.count(); ++i) {
    stack_.push(near.bound(i), {pair.object, near.child(i)});
  }
}

//! Lower bounds [m^2] of the squared distances between an element and the children of a node of the surface; those
//! above the limit are rough.
template <int K>
FourFloats MeshSearch::boundsOf(int element, int node, double limit) const {
  const Corners<K> corners = object_->corners<K>(element);
  const FourFloats by_boxes = surface_.tree()[node].squaredDistances(object_->boxOf(element));
  if (!(by_boxes[0] < limit || by_boxes[1] < limit || by_boxes[2] < limit || by_boxes[3] < limit)) {
    return by_boxes;
  }
  FourFloats bounds = larger(by_boxes, surface_.discs(node).squaredDistances(FloatElement<K>(corners)));
  for (int slot = 0; slot < 4; ++slot) {
    if (bounds[slot] < limit) {
      const double closer = surface_.discs(node).squaredDistance<K>(slot, corners);
      bounds[slot] = std::max(bounds[slot], static_cast<float>(closer) * (1.0F - 1e-6F));
    }
  }
  return bounds;
}

//! Whether a piece of the object, other than the one known to be outside, has its first point inside.
bool MeshSearch::pieceInside(int certified_piece) {
  const std::vector<int>& pieces = object_->pieces();
  for (int piece = 0; surface_.closed() && piece < static_cast<int>(pieces.size()); ++piece) {
    Box point;
    point.include(object_->point(pieces[piece]));
    if (piece != certified_piece && surface_.box().overlaps(point) && cornerSample(pieces[piece], -1).distance < 0.0) {
      return true;
    }
  }
  return false;
}

//! @param least_depth [m] what is not deeper need not be found
MeshPlace MeshSearch::deepest(double least_depth) {
  MeshPlace best;
  best.distance = -least_depth;
  descend(0, &best);
  return best.known() ? best : MeshPlace();
}

//! @param child a node, or a leaf as ~index
void MeshSearch::descend(int child, MeshPlace* best) {
  const auto threshold = [best] { return 0.5 * ElementDepth::tolerance(-best->distance) - best->distance; };
  if (child < 0) {
    const MeshPlace place = deepestOf(~child, threshold());
    if (place.distance < best->distance) {
      *best = place;
    }
    return;
  }
  const BoxNode& node = object_->tree()[child];
  std::array<Candidate, 4> candidates;
  int count = 0;
  for (int slot = 0; slot < 4; ++slot) {
    if (node.children[slot] != BoxNode::kNone) {
      const double bound = depthBound(node.children[slot], node.childBox(slot), best);
      int at = count++;
      for (; at > 0 && candidates[at - 1].depth < bound; --at) {
        candidates[at] = candidates[at - 1];
      }
      candidates[at] = {bound, node.children[slot]};
    }
  }
  for (int i = 0; i < count && candidates[i].depth > threshold(); ++i) {
    descend(candidates[i].child, best);
  }
}

//! How deep [m] a child's point can be at most: the depth changes by no more than the way, and inside it is at most the
//! distance to any triangle, which is convex.
double MeshSearch::depthBound(int child, const Box& box, MeshPlace* best) {
  const int representative = object_->representative(child);
  const SurfacePoint& there = cornerSample(representative, -1);
  if (there.distance < best->distance) {
    *best = placeOfPoint(representative, there);
  }
  const Vector3& point = object_->point(representative);
  const Vector3 middle = box.middle(), half = box.halfSides();
  double way = 0.0, farthest = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3 signs(corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? 1.0 : -1.0);
    const Vector3 place = middle + half.cwiseProduct(signs);
    way = std::max(way, (place - point).squaredNorm());
    if (there.distance < 0.0) {
      farthest = std::max(farthest, surface_.distanceTo(there.triangle, place));
    }
  }
  const double by_way = std::sqrt(way) - there.distance;
  return there.distance < 0.0 ? std::min(by_way, farthest) : by_way;
}

MeshPlace MeshSearch::placeOfPoint(int point, const SurfacePoint& there) const {
  const int element = object_->elementOf(object_->firstOf(point));
  Weights weights = {0.0, 0.0, 0.0};
  const Triangle& vertices = object_->element(element);
  weights[std::find(vertices.begin(), vertices.end(), point) - vertices.begin()] = 1.0;
  return placeAt(element, weights, there.distance, there.triangle);
}

MeshPlace MeshSearch::deepestOf(int element, double threshold) {
  std::array<SurfacePoint, 3> samples;
  int hint = -1;
  for (int k = 0; k < object_->cornerCount(); ++k) {
    samples[k] = cornerSample(object_->element(element)[k], hint);
    hint = samples[k].triangle;
  }
  const DeepPoint found = depth_.find(object_->corners<3>(element), object_->cornerCount(), samples, threshold);
  return found.triangle < 0 ? MeshPlace() : placeAt(element, found.weights, -found.depth, found.triangle);
}

void MeshSearch::elements(const ObjectTree& object, double limit, const MeshPlace& guess,
                          std::vector<MeshPlace>* places) {
  start(object);
  const bool inside = surface_.closed() && minimum(object, 0.0, guess).distance <= 0.0;
  places->assign(object.size(), MeshPlace());
  last_triangles_.resize(object.size(), -1);
  const double reach = std::max(limit, 0.0);
  for (int element = 0; element < object.size(); ++element) {
    const FourFloats away = surface_.tree()[0].squaredDistances(object.boxOf(element));
    if (*std::min_element(&away[0], &away[0] + 4) <= reach * reach) {
      (*places)[element] = inside ? elementPlace(element, limit) : outsidePlace(element, limit);
    }
  }
}

//! The nearest pair of one element, if it is not farther apart than the bound [m].
MeshSearch::Nearest MeshSearch::nearestOfElement(int element, double bound) {
  const int last = last_triangles_[element];
  if (last >= 0) {
    const Corners<3> corners = object_->corners<3>(element);  // of a segment: without an area
    ElementNearest at{INFINITY};
    ElementDistance<3>(corners, surface_.corners(last)).improve(&at);
    bound = std::min(bound, std::sqrt(at.squared));
  }
  bound += kSlack;
  const Nearest found = nearestPair(~element, bound * bound);
  last_triangles_[element] = found.triangle >= 0 ? found.triangle : last;
  return found;
}

MeshPlace MeshSearch::outsidePlace(int element, double limit) {
  const Nearest found = nearestOfElement(element, std::max(limit, 0.0));
  const MeshPlace place =
      found.element < 0 ? MeshPlace() : placeAt(element, found.at.weights, std::sqrt(found.at.squared), found.triangle);
  return place.distance <= limit ? middleOfLevel(place) : MeshPlace();
}

MeshPlace MeshSearch::elementPlace(int element, double limit) {
  double least = INFINITY;
  if (lowestPossible(element, &least) > limit) {
    return {};
  }
  MeshPlace crossing;
  if (least >= 0.0) {
    const Nearest found = nearestOfElement(element, std::max(std::min(limit, least), 0.0));
    if (found.element < 0) {
      return {};
    }
    crossing = placeAt(element, found.at.weights, std::sqrt(found.at.squared), found.triangle);
    if (found.at.squared > 0.0 || !surface_.closed()) {
      return crossing.distance <= limit ? middleOfLevel(crossing) : MeshPlace();
    }
  }
  MeshPlace place = deepestOf(element, -limit - kSlack - ElementDepth::tolerance(-limit));
  if (place.distance > crossing.distance) {
    place = crossing;
  }
  return place.distance <= limit ? middleOfLevel(place) : MeshPlace();
}

//! A lower bound [m] of an element's signed distance. It changes by no more than the way, and the ways from a point of
//! a triangle to its corners add up to at most its two longer sides.
//! @param least gets that of its corners
double MeshSearch::lowestPossible(int element, double* least) {
  const Triangle& vertices = object_->element(element);
  const int corners = object_->cornerCount();
  double sum = 0.0, around = 0.0, shortest = INFINITY;
  int hint = -1;
  *least = INFINITY;
  for (int k = 0; k < corners; ++k) {
    const SurfacePoint& sample = cornerSample(vertices[k], hint);
    const double side = (object_->point(vertices[(k + 1) % corners]) - object_->point(vertices[k])).norm();
    hint = sample.triangle;
    *least = std::min(*least, sample.distance);
    sum += sample.distance;
    around += side;
    shortest = std::min(shortest, side);
  }
  return (sum - (around - shortest)) / corners;
}

//! Where corners are as near, over the same plane, their mean (with the place, if there is one such corner), if it is
//! so, too.
MeshPlace MeshSearch::middleOfLevel(const MeshPlace& place) {
  Weights mean = {0.0, 0.0, 0.0};
  int count = 0;
  for (int k = 0; k < object_->cornerCount(); ++k) {
    const Vector3& corner = object_->point(place.vertices[k]);
    if (surface_.distanceToPlane(place.triangle, corner) <= std::fabs(place.distance) + kLevel &&
        cornerSample(place.vertices[k], place.triangle).distance <= place.distance + kLevel) {
      mean[k] += 1.0;
      ++count;
    }
  }
  if (count == 1) {
    std::transform(mean.begin(), mean.end(), place.weights.begin(), mean.begin(), std::plus<double>());
    ++count;
  }
  if (count == 0) {
    return place;
  }
  for (double& weight : mean) {
    weight /= count;
  }
  const Vector3 point = weighted<3>(object_->corners<3>(place.element), mean);
  const SurfacePoint there = surface_.nearest(point, place.triangle);
  return there.distance <= place.distance + kLevel ? placeAt(place.element, mean, there.distance, there.triangle)
                                                   : place;
}

}  // namespace distance
}  // namespace deformable_manipulation
