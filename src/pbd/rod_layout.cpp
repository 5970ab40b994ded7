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

//! Points on a level catenary of the given length, tilted to its chord.
//! Exact for a chord across gravity; elsewhere a good start for settling.
//! @param reached arc lengths of the points, as parts of the length
std::vector<Vector3> hang(const Vector3& from, const Vector3& to, double length, const std::vector<double>& reached,
                          const Vector3& gravity) {
  const int count = static_cast<int>(reached.size()) - 1;
  std::vector<Vector3> points(reached.size());
  const Vector3 chord = to - from;
  const double span = std::max(chord.norm(), 1e-3 * length);
  const Vector3 along = chord.norm() > 0.0 ? Vector3(chord.normalized()) : gravity.unitOrthogonal();
  const double ratio = length / span;
  if (ratio < 1.0 + 1e-9) {
    for (int i = 0; i <= count; ++i) {
      points[i] = from + reached[i] * chord;
    }
    return points;
  }
  const Vector3 down = sagDirection(gravity, along);
  const double half = solveCatenary(ratio);
  const double scale = 0.5 * span / half;  // m, horizontal tension over weight per length
  for (int i = 0; i <= count; ++i) {
    const double s = length * (reached[i] - 0.5);
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

void layOutBetween(const RodParameters& rod, const RodPieces& pieces, const HeldPoint& first, const HeldPoint& last,
                   std::vector<Pose>& segments) {
  const int count = last.particle - first.particle - 1;
  if (count == 0) {
    return;
  }
  const double begin = pieces.ends[first.particle + 1];
  const double length = pieces.equal ? count * pieces.usual : pieces.ends[last.particle] - begin;
  std::vector<double> reached;
  for (int i = 0; i <= count; ++i) {
    reached.push_back(pieces.equal ? static_cast<double>(i) / count
                                   : (pieces.ends[first.particle + 1 + i] - begin) / length);
  }
  const Vector3 from = first.pose.position + 0.5 * pieces.lengths[first.particle] * tangent(first.pose);
  const Vector3 to = last.pose.position - 0.5 * pieces.lengths[last.particle] * tangent(last.pose);
  const std::vector<Vector3> ends = hang(from, to, length, reached, rod.gravity);
  Quaternion orientation = first.pose.orientation;
  for (int i = 0; i < count; ++i) {
    const Vector3 direction = (ends[i + 1] - ends[i]).normalized();
    orientation = carried(orientation, direction);
    segments[first.particle + 1 + i] = {0.5 * (ends[i] + ends[i + 1]), orientation};
  }
}

//! The segments from one to another in the natural shape, end to end, both included; the other may come before it.
std::vector<Pose> naturalPieces(const RodPieces& pieces, const NaturalJoints& natural, const Pose& start, int from,
                                int to) {
  const int step = to < from ? -1 : 1;
  std::vector<Pose> poses{start};
  for (int i = from; i != to; i += step) {
    const Quaternion& turn = natural.turns[step > 0 ? i : i - 1];
    const Pose& last = poses.back();
    Pose next;
    next.orientation = (last.orientation * (step > 0 ? turn : turn.conjugate())).normalized();
    const double before = 0.5 * pieces.lengths[i];
    const double after = 0.5 * pieces.lengths[i + step];
    next.position = last.position + step * (before * tangent(last) + after * tangent(next));
    poses.push_back(next);
  }
  return poses;
}

// Of a span's length: if the natural shape misses the next hold by less, it is the first guess.
constexpr double kNearMiss = 0.2;

//! Lays out a span in the natural shape, moved so that it ends at the next hold. @return whether that is near
bool layOutNaturally(const RodPieces& pieces, const NaturalJoints& natural, const HeldPoint& first,
                     const HeldPoint& last, std::vector<Pose>& segments) {
  const std::vector<Pose> poses = naturalPieces(pieces, natural, first.pose, first.particle, last.particle);
  const Vector3 missing = last.pose.position - poses.back().position;
  const int joints = last.particle - first.particle;
  if (missing.norm() > kNearMiss * pieces.between(first.particle, last.particle)) {
    return false;
  }
  for (int i = 1; i < joints; ++i) {
    const double share = static_cast<double>(i) / joints;
    segments[first.particle + i] = {poses[i].position + share * missing, poses[i].orientation};
  }
  return true;
}

//! The ends beyond the first and the last hold, or all of a rod that is not held.
void layOutNaturalEnds(const RodPieces& pieces, const NaturalJoints& natural, int first, int last,
                       std::vector<Pose>& segments) {
  const int count = static_cast<int>(segments.size());
  const std::vector<Pose> before = naturalPieces(pieces, natural, segments[first], first, 0);
  const std::vector<Pose> after = naturalPieces(pieces, natural, segments[last], last, count - 1);
  for (int i = 0; i < first; ++i) {
    segments[i] = before[first - i];
  }
  for (int i = last + 1; i < count; ++i) {
    segments[i] = after[i - last];
  }
}

}  // namespace

std::vector<Pose> layOutRod(const RodParameters& rod, const RodPieces& pieces, const NaturalJoints& natural,
                            const std::vector<HeldPoint>& holds) {
  std::vector<Pose> segments(rod.segments);
  Pose base = rod.pose;
  int base_segment = 0;
  base.position += 0.5 * pieces.lengths[0] * tangent(base);
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
    const int start_segment = nearest != nullptr ? nearest->particle : base_segment;
    segments[i] = {start.position + pieces.between(start_segment, i) * tangent(start), start.orientation};
  }
  if (!natural.empty()) {
    layOutNaturalEnds(pieces, natural, holds.empty() ? 0 : holds.front().particle,
                      holds.empty() ? 0 : holds.back().particle, segments);
  }
  for (std::size_t i = 0; i + 1 < holds.size(); ++i) {
    if (natural.empty() || !layOutNaturally(pieces, natural, holds[i], holds[i + 1], segments)) {
      layOutBetween(rod, pieces, holds[i], holds[i + 1], segments);
    }
  }
  return segments;
}

}  // namespace pbd
}  // namespace deformable_manipulation
