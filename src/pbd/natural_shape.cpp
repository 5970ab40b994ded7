#include "natural_shape.h"

#include <algorithm>
#include <cmath>

namespace deformable_manipulation {
namespace pbd {
namespace {

//! The rotation by a rotation vector [rad].
Quaternion rotationBy(const Vector3& turn) {
  const double angle = turn.norm();
  return angle > 0.0 ? Quaternion(Eigen::AngleAxisd(angle, turn / angle)) : Quaternion::Identity();
}

//! count + 1 points at equal distances along a line of points.
std::vector<Vector3> resampled(const std::vector<Vector3>& line, int count) {
  std::vector<double> reached(line.size(), 0.0);
  for (std::size_t i = 1; i < line.size(); ++i) {
    reached[i] = reached[i - 1] + (line[i] - line[i - 1]).norm();
  }
  std::vector<Vector3> points;
  std::size_t piece = 1;
  for (int i = 0; i <= count; ++i) {
    const double wanted = reached.back() * i / count;
    while (piece + 1 < line.size() && reached[piece] < wanted) {
      ++piece;
    }
    const double t = (wanted - reached[piece - 1]) / (reached[piece] - reached[piece - 1]);
    points.push_back((1.0 - t) * line[piece - 1] + t * line[piece]);
  }
  return points;
}

//! The turn of each joint of a rod whose centre line is given.
std::vector<Quaternion> turnsAlong(const RodParameters& rod) {
  const std::vector<Vector3> ends = resampled(rod.natural_shape.points, rod.segments);
  const Quaternion twisted = rotationBy({rod.natural_shape.twist * rod.segmentLength(), 0.0, 0.0});
  Quaternion frame = Quaternion::FromTwoVectors(Vector3::UnitX(), ends[1] - ends[0]);
  std::vector<Quaternion> turns;
  for (int i = 1; i < rod.segments; ++i) {
    const Vector3 along = frame * Vector3::UnitX();
    const Quaternion next = (Quaternion::FromTwoVectors(along, ends[i + 1] - ends[i]) * frame * twisted).normalized();
    turns.push_back(frame.conjugate() * next);
    frame = next;
  }
  return turns;
}

}  // namespace

NaturalJoints naturalJoints(const RodParameters& rod) {
  const NaturalShape& shape = rod.natural_shape;
  NaturalJoints joints;
  if (shape.isStraight()) {
    return joints;
  }
  const double l = rod.segmentLength();
  if (shape.points.empty()) {
    const Vector3 turn(l * shape.twist, l * shape.curvature[0], l * shape.curvature[1]);
    joints.turns.assign(static_cast<std::size_t>(rod.segments) - 1, rotationBy(turn));
  } else {
    joints.turns = turnsAlong(rod);
  }
  for (const Quaternion& turn : joints.turns) {
    const Vector3 ahead = turn * Vector3::UnitX();
    const Vector3 behind = turn.conjugate() * Vector3::UnitX();
    joints.ahead.insert(joints.ahead.end(), ahead.data(), ahead.data() + 3);
    joints.behind.insert(joints.behind.end(), behind.data(), behind.data() + 3);
    joints.twist.push_back(2.0 * std::atan2(turn.x(), turn.w()));
  }
  return joints;
}

}  // namespace pbd
}  // namespace deformable_manipulation
