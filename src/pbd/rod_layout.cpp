#include "rod_layout.h"

#include <cmath>

namespace deformable_manipulation {
namespace pbd {
namespace {

//! The direction in which a slack piece hangs: gravity without its part along the chord.
Vector3 sagDirection(const Vector3& gravity, const Vector3& along) {
  const Vector3 across = gravity - gravity.dot(along) * along;
  if (across.norm() > 1e-6 * (1.0 + gravity.norm())) {
    return across.normalized();
  }
  return along.unitOrthogonal();
}

//! Solves sinh(x) / x = ratio for x > 0 (ratio > 1) by Newton's method from an upper estimate.
double solveCatenary(double ratio) {
  double x = ratio < 3.0 ? std::sqrt(6.0 * (ratio - 1.0)) : std::log(2.0 * ratio) + std::log(std::log(2.0 * ratio));
  for (int i = 0; i < 50; ++i) {
    const double step = (std::sinh(x) - ratio * x) / (std::cosh(x) - ratio);
    x -= step;
    if (std::abs(step) < 1e-14 * x) {
      break;
    }
  }
  return x;
}

//! count + 1 points at equal arc length on a level catenary of the given length, tilted to its chord.
//! Exact for a chord across gravity; elsewhere a good start for settling.
std::vector<Vector3> hang(const Vector3& from, const Vector3& to, double length, int count, const Vector3& gravity) {
  std::vector<Vector3> points(count + 1);
  const Vector3 chord = to - from;
  const double span = std::max(chord.norm(), 1e-3 * length);
  const Vector3 along = chord.norm() > 0.0 ? Vector3(chord.normalized()) : gravity.unitOrthogonal();
  const double ratio = length / span;
  if (ratio < 1.0 + 1e-9) {
    for (int i = 0; i <= count; ++i) {
      points[i] = from + (static_cast<double>(i) / count) * chord;
    }
    return points;
  }
  const Vector3 down = sagDirection(gravity, along);
  const double half = solveCatenary(ratio);
  const double scale = 0.5 * span / half;  // m, horizontal tension over weight per length
  for (int i = 0; i <= count; ++i) {
    const double s = length * (static_cast<double>(i) / count - 0.5);
    const double x = scale * std::asinh(s / scale);
    const double depth = scale * (std::cosh(half) - std::cosh(x / scale));
    points[i] = from + (x + 0.5 * span) * along + depth * down;
  }
  return points;
}

Vector3 tangent(const Pose& pose) { return pose.orientation * Vector3::UnitX(); }

//! Turns an orientation by the smallest rotation that brings its tangent onto a direction.
Quaternion carried(const Quaternion& orientation, const Vector3& direction) {
  return (Quaternion::FromTwoVectors(orientation * Vector3::UnitX(), direction) * orientation).normalized();
}

void layOutBetween(const RodParameters& rod, const HeldPoint& first, const HeldPoint& last,
                   std::vector<Pose>& segments) {
  const int count = last.particle - first.particle - 1;
  if (count == 0) {
    return;
  }
  const double half = 0.5 * rod.segmentLength();
  const Vector3 from = first.pose.position + half * tangent(first.pose);
  const Vector3 to = last.pose.position - half * tangent(last.pose);
  const std::vector<Vector3> ends = hang(from, to, count * rod.segmentLength(), count, rod.gravity);
  Quaternion orientation = first.pose.orientation;
  for (int i = 0; i < count; ++i) {
    const Vector3 direction = (ends[i + 1] - ends[i]).normalized();
    orientation = carried(orientation, direction);
    segments[first.particle + 1 + i] = {0.5 * (ends[i] + ends[i + 1]), orientation};
  }
}

}  // namespace

std::vector<Pose> layOutRod(const RodParameters& rod, const std::vector<HeldPoint>& holds) {
  std::vector<Pose> segments(rod.segments);
  Pose base = rod.pose;
  int base_segment = 0;
  base.position += 0.5 * rod.segmentLength() * tangent(base);
  if (!holds.empty()) {
    base = holds.front().pose;
    base_segment = holds.front().particle;
  }
  for (int i = 0; i < rod.segments; ++i) {
    const HeldPoint* nearest = nullptr;
    for (const HeldPoint& held : holds) {
      if (held.particle <= i) {
        nearest = &held;
      }
    }
    const Pose& start = nearest != nullptr ? nearest->pose : base;
    const int steps = i - (nearest != nullptr ? nearest->particle : base_segment);
    segments[i] = {start.position + steps * rod.segmentLength() * tangent(start), start.orientation};
  }
  for (std::size_t i = 0; i + 1 < holds.size(); ++i) {
    layOutBetween(rod, holds[i], holds[i + 1], segments);
  }
  return segments;
}

}  // namespace pbd
}  // namespace deformable_manipulation
