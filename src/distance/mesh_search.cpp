#include "mesh_search.h"

#include <algorithm>
#include <functional>

namespace deformable_manipulation {
namespace distance {
namespace {

constexpr double kSameDistance = 1e-9;  // m, differences of distance below it count as none

}  // namespace

void MeshSearch::start(ObjectTree& object, MovingBounds* bounds) {
  startPairs(object, bounds);
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
  return {distance, triangle, element, object_->element(element), weights, SurfacePoint()};
}

MeshPlace MeshSearch::placeAt(int element, const Weights& weights, const SurfacePoint& there) const {
  return {there.distance, there.triangle, element, object_->element(element), weights, there};
}

MeshPlace MeshSearch::minimum(ObjectTree& object, double bound, const MeshPlace& guess, MovingBounds* bounds) {
  start(object, bounds);
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
  const Nearest found = nearestPair(std::max(upper, 0.0));
  if (found.element < 0) {
    return pieceInside(-1) ? deepest(known_depth) : MeshPlace();
  }
  MeshPlace place = placeAt(found.element, found.at.weights, std::sqrt(found.at.squared), found.piece);
  if (!surface_.closed()) {
    return place;
  }
  const bool touches = found.at.squared == 0.0;
  const Vector3 point = weighted<3>(object.corners<3>(place.element), place.weights);
  place.there = surface_.nearest(point, place.triangle);
  if (touches || place.there.distance < 0.0 || pieceInside(object.pieceOf(place.vertices[0]))) {
    const MeshPlace deep = deepest(known_depth);
    return deep.known() ? deep : place;
  }
  return place;
}

//! The unit vector from the surface towards the element, or zero if they touch.
Vector3 MeshSearch::towards(const Nearest& pair) const {
  const Vector3 point = weighted<3>(object_->corners<3>(pair.element), pair.at.weights);
  const Corners<3> triangle = surface_.corners(pair.piece);
  return (point - weighted<3>(triangle, nearestOnTriangle(point, triangle).weights)).normalized();
}

//! Returns a lower bound [m^2] of the element's squared distance.
template <int K>
double MeshSearch::search(int element, const Nearest& known, Nearest* nearest) {
  const Corners<K> corners = object_->corners<K>(element);
  const Box box = boxAround(corners);
  const FloatElement<K> rough(corners);
  Eigen::Vector3f direction = known.direction.cast<float>();
  double beyond = INFINITY;  // m^2, least bound of what has been left out
  stack_.push(0.0F, 0);
  while (!stack_.empty()) {
    const auto entry = stack_.pop();
    if (entry.bound >= nearest->at.squared) {
      continue;
    }
    if (entry.what < 0) {
      const int triangle = ~entry.what;
      if (triangle == known.piece) {
        if (known.at.squared < nearest->at.squared) {
          *nearest = known;  // found again
        }
      } else if (ElementDistance<K>(corners, surface_.corners(triangle)).improve(&nearest->at)) {
        nearest->element = element;
        nearest->piece = triangle;
        direction = towards(*nearest).cast<float>();
      }
      beyond = nearest->at.squared;
      continue;
    }
    const BoxNode& node = surface_.tree()[entry.what];
    const DiscNode& discs = surface_.discs(entry.what);
    FourFloats order = node.squaredDistances(box);
    FourFloats bounds = order;
    if (anyBelow(bounds, nearest->at.squared)) {
      order = larger(order, discs.squaredDistances(rough));
      bounds = direction.squaredNorm() > 0.0F ? larger(order, discs.squaredDistancesAlong(direction, rough))
                                              : closerBounds<K>(corners, node, discs, order, nearest->at.squared);
    }
    // Of equally near triangles the first counts: the order must not depend on the direction.
    const NearChildren near(order, bounds, nearest->at.squared);
    for (int i = 0; i < near.count(); ++i) {
      stack_.push(bounds[near.slot(i)], node.children[near.slot(i)]);
    }
    beyond = std::min(beyond, double(near.leastLeftOut()));
  }
  return nearest->element < 0 ? beyond : nearest->at.squared;
}

//! Closer ones in place of bounds [m^2] that are below the limit, but for triangles: those are tested as fast
//! themselves.
template <int K>
FourFloats MeshSearch::closerBounds(const Corners<K>& corners, const BoxNode& node, const DiscNode& discs,
                                    FourFloats bounds, double limit) {
  for (int slot = 0; slot < 4; ++slot) {
    if (node.children[slot] >= 0 && bounds[slot] < limit) {
      const double closer = discs.squaredDistance<K>(slot, corners);
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
    const bool may_be = surface_.endless() || surface_.box().overlaps(point);
    if (piece != certified_piece && may_be && cornerSample(pieces[piece], -1).distance < 0.0) {
      return true;
    }
  }
  return false;
}

//! @param least_depth [m] what is not deeper need not be found
MeshPlace MeshSearch::deepest(double least_depth) {
  MeshPlace best;
  best.distance = -least_depth;
  object_->fit();
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
  return placeAt(element, weights, there);
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

void MeshSearch::elements(ObjectTree& object, double limit, const MeshPlace& guess, MovingBounds* bounds,
                          std::vector<MeshPlace>* places) {
  start(object, bounds);
  const bool inside = surface_.closed() && minimum(object, 0.0, guess, bounds).distance <= 0.0;
  places->assign(object.size(), MeshPlace());
  const double reach = std::max(limit, 0.0);
  for (int element = 0; element < object.size(); ++element) {
    if (!inside && bounds->of(element) < reach + kSlack) {
      (*places)[element] = outsidePlace(element, limit);
    } else if (inside && (surface_.endless() || touchesBox(element, reach))) {
      (*places)[element] = elementPlace(element, limit);
    }
  }
}

//! Compares the element and the triangle of a pair.
void MeshSearch::improve(Nearest* pair) const {
  const Corners<3> triangle = surface_.corners(pair->piece);
  if (object_->surface()) {
    ElementDistance<3>(object_->corners<3>(pair->element), triangle).improve(&pair->at);
  } else {
    ElementDistance<2>(object_->corners<2>(pair->element), triangle).improve(&pair->at);
  }
}

//! Whether an element is not farther than the reach [m] from the boxes around the surface.
bool MeshSearch::touchesBox(int element, double reach) const {
  const FourFloats away = surface_.tree()[0].squaredDistances(boxAround(object_->corners<3>(element)));
  return std::min({away[0], away[1], away[2], away[3]}) <= reach * reach;
}

MeshPlace MeshSearch::outsidePlace(int element, double limit) {
  const Nearest found = nearestWithin(element, std::max(limit, 0.0));
  const MeshPlace place =
      found.element < 0 ? MeshPlace() : placeAt(element, found.at.weights, std::sqrt(found.at.squared), found.piece);
  return place.distance <= limit ? middleOfLevel(place) : MeshPlace();
}

MeshPlace MeshSearch::elementPlace(int element, double limit) {
  double least = INFINITY;
  if (lowestPossible(element, &least) > limit) {
    return {};
  }
  MeshPlace crossing;
  if (least >= 0.0) {
    const Nearest found = nearestWithin(element, std::max(std::min(limit, least), 0.0));
    if (found.element < 0) {
      return {};
    }
    crossing = placeAt(element, found.at.weights, std::sqrt(found.at.squared), found.piece);
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
  int count = 0, alone = -1;
  for (int k = 0; k < object_->cornerCount(); ++k) {
    const Vector3& corner = object_->point(place.vertices[k]);
    if (surface_.distanceToPlane(place.triangle, corner) <= std::fabs(place.distance) + kSameDistance &&
        cornerSample(place.vertices[k], place.triangle).distance <= place.distance + kSameDistance) {
      mean[k] += 1.0;
      alone = ++count == 1 ? k : -1;
    }
  }
  if (count == 1) {
    std::transform(mean.begin(), mean.end(), place.weights.begin(), mean.begin(), std::plus<double>());
    ++count;
  }
  if (count == 0) {
    return place;
  }
  if (alone >= 0 && place.weights[alone] == 1.0) {
    return placeAt(place.element, place.weights, cornerSample(place.vertices[alone], place.triangle));
  }
  for (double& weight : mean) {
    weight /= count;
  }
  const Vector3 point = weighted<3>(object_->corners<3>(place.element), mean);
  const SurfacePoint there = surface_.nearest(point, place.triangle);
  return there.distance <= place.distance + kSameDistance ? placeAt(place.element, mean, there) : place;
}

}  // namespace distance
}  // namespace deformable_manipulation
