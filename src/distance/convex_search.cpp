#include "convex_search.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace deformable_manipulation {
namespace distance {
namespace {

constexpr double kFlat = 1e-14;         // slope below which an edge is level
constexpr double kExact = 1e-12;        // m, below a minimum that nothing needs to be searched for
constexpr double kSameDistance = 1e-9;  // m, differences of distance below it count as none
constexpr double kShortest = 1e-4;      // of an edge, of which less than that is level counts as a point
constexpr int kMostSteps = 100;         // of a search along an edge
constexpr int kMostPlanes = 200;        // sampled in a triangle

double tangent(const ConvexSample& at, const Vector3& point) { return at.distance + at.gradient.dot(point - at.point); }

Weights onEdgeAt(int from, int to, double parameter) {
  Weights weights = {0.0, 0.0, 0.0};
  weights[from] = 1.0 - parameter;
  weights[to] += parameter;
  return weights;
}

}  // namespace

ConvexSample ConvexSearch::sample(const Vector3& point) const {
  ConvexSample sample;
  sample.point = point;
  sample.distance = shape_.signedDistance(point, &sample.gradient);
  return sample;
}

double ConvexSearch::lowerBound(const std::array<const ConvexSample*, 3>& corners, int count) {
  double bound = -INFINITY;
  for (int k = 0; k < count; ++k) {
    double lowest = corners[k]->distance;
    for (int other = 0; other < count; ++other) {
      lowest = std::min(lowest, tangent(*corners[k], corners[other]->point));
    }
    bound = std::max(bound, lowest);
  }
  return bound;
}

ConvexPlace ConvexSearch::minimum(const std::array<const ConvexSample*, 3>& corners, int count) {
  corners_ = corners;
  count_ = count;
  found_count_ = 0;
  best_.at.distance = INFINITY;
  for (int from = 0; from < (count == 3 ? 3 : 1); ++from) {
    consider(edgeMinimum(from, (from + 1) % count));
  }
  if (count == 3 && !certain()) {
    overFace();
    if (!certain()) {
      cutPlanes();
    }
  }
  return middle();
}

ConvexSearch::Place ConvexSearch::placeAt(const Weights& weights) const {
  Vector3 point = Vector3::Zero();
  for (int k = 0; k < count_; ++k) {
    point += weights[k] * corners_[k]->point;
  }
  return {sample(point), weights};
}

ConvexSearch::Place ConvexSearch::between(int from, int to, double parameter) const {
  if (parameter <= 0.0 || parameter >= 1.0) {
    return {*corners_[parameter <= 0.0 ? from : to], onEdgeAt(from, to, parameter <= 0.0 ? 0.0 : 1.0)};
  }
  return placeAt(onEdgeAt(from, to, parameter));
}

//! The middle of the edge's points that are as near as its nearest one.
ConvexSearch::Place ConvexSearch::edgeMinimum(int from, int to) const {
  const ConvexSample &first = *corners_[from], &last = *corners_[to];
  const Vector3 way = last.point - first.point;
  double low = 0.0, high = 1.0, best = first.distance <= last.distance ? 0.0 : 1.0;
  double at_low = first.distance, at_high = last.distance, least = std::min(at_low, at_high);
  double rise_low = first.gradient.dot(way), rise_high = last.gradient.dot(way);
  for (int step = 0; step < kMostSteps && rise_low < 0.0 && rise_high > 0.0; ++step) {
    // Where both tangents meet is the minimum of straight pieces; the slope of smooth ones is 0 where its secant is.
    const double meeting = (at_high - at_low + rise_low * low - rise_high * high) / (rise_low - rise_high);
    const double secant = (low * rise_high - high * rise_low) / (rise_high - rise_low);
    const double middle = 0.5 * (low + high);
    double next = step % 3 == 0 ? meeting : (step % 3 == 1 ? secant : middle);
    if (least - (at_low + rise_low * (meeting - low)) <= 0.0 || middle <= low || middle >= high) {
      break;
    }
    next = next > low && next < high ? next : middle;
    const ConvexSample there = sample(first.point + next * way);
    const double rise = there.gradient.dot(way);
    if (there.distance < least) {
      least = there.distance;
      best = next;
    }
    if (std::fabs(rise) <= kFlat * way.norm()) {
      break;
    }
    (rise < 0.0 ? low : high) = next;
    (rise < 0.0 ? at_low : at_high) = there.distance;
    (rise < 0.0 ? rise_low : rise_high) = rise;
  }
  const double level = least + kSameDistance;
  const double start = first.distance <= level ? 0.0 : levelEnd(from, to, best, 0.0, level);
  const double end = last.distance <= level ? 1.0 : levelEnd(from, to, best, 1.0, level);
  return between(from, to, 0.5 * (start + end));
}

//! How far an edge is level between a parameter where it is and an end where it is not.
double ConvexSearch::levelEnd(int from, int to, double inside, double end, double level) const {
  double outside = inside + kShortest * (end - inside);
  if (between(from, to, outside).at.distance > level) {
    return inside;
  }
  std::swap(inside, outside);
  outside = end;
  for (int step = 0; step < 40; ++step) {
    const double middle = 0.5 * (inside + outside);
    (between(from, to, middle).at.distance <= level ? inside : outside) = middle;
  }
  return inside;
}

void ConvexSearch::consider(const Place& place) {
  found_[found_count_++] = place;
  if (place.at.distance < best_.at.distance) {
    best_ = place;
  }
}

//! Whether the tangent at the best point shows that no other is nearer.
bool ConvexSearch::certain() const {
  for (const ConvexSample* corner : corners_) {
    if (best_.at.gradient.dot(corner->point - best_.at.point) < -kExact) {
      return false;
    }
  }
  return true;
}

//! The triangle's points that are over the solid's farthest points to both sides.
void ConvexSearch::overFace() {
  const Corners<3> face = {corners_[0]->point, corners_[1]->point, corners_[2]->point};
  const Vector3 normal = (face[1] - face[0]).cross(face[2] - face[0]);
  if (!(normal.squaredNorm() > 0.0)) {
    return;
  }
  for (const Vector3& towards : {normal, Vector3(-normal)}) {
    consider(placeAt(nearestOnTriangle(shape_.support(towards), face).weights));
  }
}

void ConvexSearch::cutPlanes() {
  cut_count_ = 0;
  Weights last = {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0};
  for (int k = 0; k < 3; ++k) {
    addCut({*corners_[k], onEdgeAt(k, k, 0.0)}, last);
  }
  for (int i = 0; i < found_count_; ++i) {
    addCut(found_[i], last);
  }
  double bound = -INFINITY;
  for (int plane = 0; plane < kMostPlanes; ++plane) {
    bound = std::max(bound, nextCut(&last));
    if (best_.at.distance - bound <= kSameDistance) {
      break;
    }
    const Place place = placeAt(last);
    addCut(place, last);
    if (place.at.distance < best_.at.distance) {
      best_ = place;
    }
  }
}

//! Where the tangents' maximum is least, and how low [m] it is there.
double ConvexSearch::nextCut(Weights* weights) {
  MatrixGame game(3);
  for (int i = 0; i < cut_count_; ++i) {
    game.add({-cuts_[i][0], -cuts_[i][1], -cuts_[i][2]});
  }
  const MatrixGame::Solution solution = game.solve();
  *weights = solution.weights;
  return -solution.bound;
}

//! Adds a place's tangent, in place of the one that matters least where the last one was sought.
void ConvexSearch::addCut(const Place& place, const Weights& last) {
  int slot = cut_count_;
  if (cut_count_ < kMostCuts) {
    ++cut_count_;
  } else {
    const auto at_last = [&last](const std::array<double, 3>& cut) {
      return last[0] * cut[0] + last[1] * cut[1] + last[2] * cut[2];
    };
    slot = static_cast<int>(std::min_element(cuts_.begin(), cuts_.end(),
                                             [&](const std::array<double, 3>& a, const std::array<double, 3>& b) {
                                               return at_last(a) < at_last(b);
                                             }) -
                            cuts_.begin());
  }
  for (int k = 0; k < 3; ++k) {
    cuts_[slot][k] = tangent(place.at, corners_[k]->point);
  }
}

//! The mean of all places that are as near as the best: it is as near, too, as the distance is convex.
ConvexPlace ConvexSearch::middle() const {
  Weights mean = {0.0, 0.0, 0.0};
  int count = 0;
  for (int i = 0; i < found_count_; ++i) {
    if (found_[i].at.distance <= best_.at.distance + kSameDistance) {
      std::transform(mean.begin(), mean.end(), found_[i].weights.begin(), mean.begin(), std::plus<double>());
      ++count;
    }
  }
  if (count == 0) {
    return {best_.at.distance, best_.weights};
  }
  for (double& weight : mean) {
    weight /= count;
  }
  return {placeAt(mean).at.distance, mean};
}

}  // namespace distance
}  // namespace deformable_manipulation
