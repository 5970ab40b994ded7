#include "natural_shape.h"

#include <algorithm>
#include <cmath>

#include "rod_pieces.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

//! The rotation by a rotation vector [rad].
Quaternion rotationBy(const Vector3& turn) {
  const double angle = turn.norm();
  return angle > 0.0 ? Quaternion(Eigen::AngleAxisd(angle, turn / angle)) : Quaternion::Identity();
}

//! The points of a line of points at the ends of a rod's segments.
std::vector<Vector3> resampled(const std::vector<Vector3>& line, const RodPieces& pieces) {
  std::vector<double> reached(line.size(), 0.0);
  for (std::size_t i = 1; i < line.size(); ++i) {
    reached[i] = reached[i - 1] + (line[i] - line[i - 1]).norm();
  }
  std::vector<Vector3> points;
  std::size_t piece = 1;
  const int count = static_cast<int>(pieces.lengths.size());
  for (int i = 0; i <= count; ++i) {
    const double wanted = reached.back() * (pieces.equal ? 1.0 * i : pieces.ends[i] / pieces.usual) / count;
    while (piece + 1 < line.size() && reached[piece] < wanted) {
      ++piece;
    }
    const double t = (wanted - reached[piece - 1]) / (reached[piece] - reached[piece - 1]);
    points.push_back((1.0 - t) * line[piece - 1] + t * line[piece]);
  }
  return points;
}

//! What a joint takes of the turn between its segments: a grip keeps the rod straight over its length.
Quaternion bentPart(const Quaternion& turn, const RodPieces& pieces, int joint) {
  return Quaternion::Identity().slerp(pieces.joint_lengths[joint] / pieces.between(joint, joint + 1), turn);
}

//! The turn of each joint of a rod whose centre line is given.
std::vector<Quaternion> turnsAlong(const RodParameters& rod, const RodPieces& pieces) {
  const std::vector<Vector3> ends = resampled(rod.natural_shape.points, pieces);
  Quaternion frame = Quaternion::FromTwoVectors(Vector3::UnitX(), ends[1] - ends[0]);
  std::vector<Quaternion> turns;
  for (int i = 1; i < rod.segments; ++i) {
    const Vector3 along = frame * Vector3::UnitX();
    const Quaternion twisted = rotationBy({rod.natural_shape.twist * pieces.between(i - 1, i), 0.0, 0.0});
    const Quaternion next = (Quaternion::FromTwoVectors(along, ends[i + 1] - ends[i]) * frame * twisted).normalized();
    const Quaternion turn = frame.conjugate() * next;
    turns.push_back(pieces.equal ? turn : bentPart(turn, pieces, i - 1));
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
  const RodPieces pieces = rodPieces(rod);
  if (shape.points.empty()) {
    for (double l : pieces.joint_lengths) {
      joints.turns.push_back(rotationBy({l * shape.twist, l * shape.curvature[0], l * shape.curvature[1]}));
    }
  } else {
    joints.turns = turnsAlong(rod, pieces);
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
