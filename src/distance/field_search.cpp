#include "field_search.h"

#include <algorithm>
#include <cmath>

namespace deformable_manipulation {
namespace distance {
namespace {

constexpr double kOnPlane = 1e-9;    // of the spacing, from a plane of the grid that does not cut
constexpr int kMostPieces = 100000;  // of an element

//! How far a point is from the field, along each axis.
Vector3 beyondField(const Vector3& point, const Vector3& extent) {
  return point - point.cwiseMax(0.0).cwiseMin(extent);
}

}  // namespace

FieldSample FieldSearch::sample(const Vector3& point) const {
  const Vector3 beyond = beyondField(point, field_.extent());
  const Vector3 on_border = point - beyond;
  FieldSample sample = within(field_.expand(field_.cellOf(on_border), on_border), beyond);
  if (!is_free_) {
    Vector3 gradient;
    const double border = borderDistance(point, &gradient);
    if (border < sample.distance) {
      sample = {border, gradient};
    }
  }
  return sample;
}

//! Distance [m] from the border around the field, negative beyond it.
double FieldSearch::borderDistance(const Vector3& point, Vector3* gradient) const {
  const Vector3 beyond = beyondField(point, field_.extent());
  const double distance = beyond.norm();
  if (distance > 0.0) {
    *gradient = -beyond / distance;
    return -distance;
  }
  double least = INFINITY;
  for (int axis = 0; axis < 3; ++axis) {
    for (int end = 0; end < 2; ++end) {
      const double away = end == 0 ? point[axis] : field_.extent()[axis] - point[axis];
      if (away < least) {
        least = away;
        *gradient = (end == 0 ? 1.0 : -1.0) * Vector3::Unit(axis);
      }
    }
  }
  return least;
}

//! @param beyond [m] from the field's nearest point, which f is the expansion around
FieldSample FieldSearch::within(const CellExpansion& f, const Vector3& beyond) const {
  Vector3 along_border = f.gradient;
  for (int axis = 0; axis < 3; ++axis) {
    along_border[axis] = beyond[axis] == 0.0 ? f.gradient[axis] : 0.0;
  }
  const double away = is_free_ ? beyond.norm() : 0.0;
  if (away == 0.0) {
    return {f.value, along_border};
  }
  if (f.value < 0.0) {
    return {f.value + away, along_border + beyond / away};
  }
  const double distance = std::hypot(away, f.value);
  return {distance, (f.value * along_border + beyond) / distance};
}

double FieldSearch::lowerBound(const Corners<3>& corners, double enough) const {
  Surroundings around;
  around.low = around.high = corners[0];
  Vector3 sum = Vector3::Zero();
  for (const Vector3& corner : corners) {
    around.low = around.low.cwiseMin(corner);
    around.high = around.high.cwiseMax(corner);
    sum += corner;
  }
  around.middle = sum / 3.0;
  around.from = field_.cellOf(around.low);
  around.to = field_.cellOf(around.high);
  double bound = field_.least(around.from, around.to);
  if (bound < enough) {
    bound = std::max(bound, bySlopes(corners, around));
  }
  if (is_free_) {
    const Vector3 gap = (-around.high).cwiseMax(around.low - field_.extent()).cwiseMax(0.0);
    return bound > 0.0 ? std::hypot(bound, gap.norm()) : bound;
  }
  Vector3 unused;
  for (const Vector3& corner : corners) {  // the border's distance is concave
    bound = std::min(bound, borderDistance(corner, &unused));
  }
  return bound;
}

//! A lower bound [m] of the field on an element: from its middle it falls no faster than the slopes around let it, and
//! that is least at a corner.
double FieldSearch::bySlopes(const Corners<3>& corners, const Surroundings& around) const {
  const Vector3 &low = around.low, &high = around.high, &middle = around.middle;
  SlopeRange slopes = field_.slopes(around.from, around.to);
  for (int axis = 0; axis < 3; ++axis) {
    if (high[axis] <= 0.0 || low[axis] >= field_.extent()[axis]) {
      slopes.least[axis] = slopes.most[axis] = 0.0;  // what is beyond the border is as the border
    } else if (low[axis] < 0.0 || high[axis] > field_.extent()[axis]) {
      slopes.least[axis] = std::min(slopes.least[axis], 0.0);
      slopes.most[axis] = std::max(slopes.most[axis], 0.0);
    }
  }
  const Vector3 on_border = middle - beyondField(middle, field_.extent());
  double fall = INFINITY;
  for (const Vector3& corner : corners) {
    const Vector3 arm = corner - middle;
    fall = std::min(fall, slopes.least.cwiseProduct(arm).cwiseMin(slopes.most.cwiseProduct(arm)).sum());
  }
  return field_.value(field_.cellOf(on_border), on_border) + fall - 1e-9;
}

FieldPlace FieldSearch::minimum(const Corners<3>& corners, int count, double limit) {
  count_ = count;
  best_ = FieldPlace();
  Piece whole;
  whole.corners = corners;
  for (int k = 0; k < 3; ++k) {
    whole.weights[k] = {0.0, 0.0, 0.0};
    whole.weights[k][std::min(k, count - 1)] = 1.0;
    whole.distances[k] = consider(corners[k], whole.weights[k]);
  }
  pieces_.assign(1, whole);
  for (int n = 0; !pieces_.empty() && n < kMostPieces; ++n) {
    const Piece piece = pieces_.back();
    pieces_.pop_back();
    const double goal = std::min(best_.distance - kTolerance, limit);
    if (lowerBound(piece.corners, goal) < goal && !cut(piece) && cellBound(piece) < goal) {
      halve(piece);
    }
  }
  return best_.distance <= limit ? middle(corners) : FieldPlace();
}

//! A lower bound [m] of what is in the field's nearest cell, for a piece that no plane of the grid cuts.
double FieldSearch::cellBound(const Piece& piece) const {
  const Corners<3>& c = piece.corners;
  const Vector3 centre = count_ == 3 ? Vector3((c[0] + c[1] + c[2]) / 3.0) : Vector3(0.5 * (c[0] + c[1]));
  const Vector3 beyond = beyondField(centre, field_.extent());
  const CellExpansion f = field_.expand(field_.cellOf(centre - beyond), centre - beyond);
  Vector3 half = Vector3::Zero();
  for (const Vector3& corner : c) {
    half = half.cwiseMax((corner - centre).cwiseAbs());
  }
  for (int axis = 0; axis < 3; ++axis) {
    half[axis] = beyond[axis] == 0.0 ? half[axis] : 0.0;
  }
  const double products = std::fabs(f.xy) * half.x() * half.y() + std::fabs(f.yz) * half.y() * half.z() +
                          std::fabs(f.zx) * half.z() * half.x() + std::fabs(f.xyz) * half.x() * half.y() * half.z();
  const FieldSample there = within(f, beyond);
  const double away = is_free_ ? beyond.norm() : 0.0;
  const Vector3 outwards = away > 0.0 ? Vector3(beyond / away) : Vector3(Vector3::Zero());
  double least = INFINITY, least_away = INFINITY, least_field = INFINITY, most_field = -INFINITY;
  for (const Vector3& corner : c) {
    const Vector3 arm = corner - centre;
    double field = f.value;
    for (int axis = 0; axis < 3; ++axis) {
      field += beyond[axis] == 0.0 ? f.gradient[axis] * arm[axis] : 0.0;
    }
    least = std::min(least, there.distance + there.gradient.dot(arm));
    least_away = std::min(least_away, away + outwards.dot(arm));
    least_field = std::min(least_field, field);
    most_field = std::max(most_field, field);
  }
  if (away > 0.0 && least_field - products < 0.0 && most_field + products > 0.0) {
    return least_field - products + std::max(least_away, 0.0);  // each of both formulas holds in a part
  }
  return least - products;
}

//! At the plane of the grid that is nearest to the middle of the piece.
bool FieldSearch::cut(const Piece& piece) {
  for (int axis = 0; axis < 3; ++axis) {
    int low = 0, high = 0;
    for (int k = 1; k < count_; ++k) {
      low = piece.corners[k][axis] < piece.corners[low][axis] ? k : low;
      high = piece.corners[k][axis] > piece.corners[high][axis] ? k : high;
    }
    const double spacing = field_.spacing()[axis];
    const double from = piece.corners[low][axis], to = piece.corners[high][axis];
    const double last = std::round(field_.extent()[axis] / spacing);
    const double plane = spacing * std::min(std::max(std::round(0.5 * (from + to) / spacing), 0.0), last);
    if (plane - from > kOnPlane * spacing && to - plane > kOnPlane * spacing) {
      divide(piece, low, high, (plane - from) / (to - from));
      return true;
    }
  }
  return false;
}

//! Across its longest edge.
void FieldSearch::halve(const Piece& piece) {
  int from = 0;
  double longest = -1.0;
  for (int k = 0; k < (count_ == 3 ? 3 : 1); ++k) {
    const double squared = (piece.corners[(k + 1) % count_] - piece.corners[k]).squaredNorm();
    if (squared > longest) {
      longest = squared;
      from = k;
    }
  }
  divide(piece, from, (from + 1) % count_, 0.5);
}

void FieldSearch::divide(const Piece& piece, int from, int to, double parameter) {
  const Vector3 point = (1.0 - parameter) * piece.corners[from] + parameter * piece.corners[to];
  Weights weights;
  for (int i = 0; i < 3; ++i) {
    weights[i] = (1.0 - parameter) * piece.weights[from][i] + parameter * piece.weights[to][i];
  }
  const double distance = consider(point, weights);
  const bool first_is_nearer = piece.distances[from] < piece.distances[to];
  for (int replaced :
       {first_is_nearer ? from : to, first_is_nearer ? to : from}) {  // the nearer half is searched first
    Piece part = piece;
    part.corners[replaced] = point;
    part.weights[replaced] = weights;
    part.distances[replaced] = distance;
    if (count_ == 2) {
      part.corners[2] = part.corners[1];
      part.weights[2] = part.weights[1];
      part.distances[2] = part.distances[1];
    }
    pieces_.push_back(part);
  }
}

double FieldSearch::distanceAt(const Vector3& point) const {
  const Vector3& extent = field_.extent();
  const bool is_inside = (point.array() >= 0.0).all() && (point.array() <= extent.array()).all();
  return is_free_ && is_inside ? field_.value(field_.cellOf(point), point) : sample(point).distance;
}

double FieldSearch::consider(const Vector3& point, const Weights& weights) {
  const double distance = distanceAt(point);
  if (distance < best_.distance) {
    best_ = {distance, weights};
  }
  return distance;
}

//! The mean of the corners that are as near as the best, if it is so, too.
FieldPlace FieldSearch::middle(const Corners<3>& corners) const {
  Weights mean = {0.0, 0.0, 0.0};
  Vector3 sum = Vector3::Zero();
  int level = 0;
  for (int k = 0; k < count_; ++k) {
    if (sample(corners[k]).distance <= best_.distance + kTolerance) {
      mean[k] = 1.0;
      sum += corners[k];
      ++level;
    }
  }
  if (level < 2) {
    return best_;
  }
  for (double& weight : mean) {
    weight /= level;
  }
  const double distance = sample(sum / level).distance;
  return distance <= best_.distance + kTolerance ? FieldPlace{distance, mean} : best_;
}

}  // namespace distance
}  // namespace deformable_manipulation
