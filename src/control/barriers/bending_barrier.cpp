#include "deformable_manipulation/control/barriers/bending_barrier.h"

#include <cmath>

namespace deformable_manipulation {
namespace control {
namespace {

constexpr double STRAIGHT = 1e-9;  // rad, below which an angle has no direction

}  // namespace

double BendingBarrier::load(const ObjectShape& shape, int joint) const {
  const Vector3 before = shape.point(joint + 1) - shape.point(joint);
  const Vector3 after = shape.point(joint + 2) - shape.point(joint + 1);
  return std::atan2(before.cross(after).norm(), before.dot(after)) / joint_lengths_[joint];
}

//! The angle grows as a segment's end moves across it, away from the other segment, over the segment's length.
void BendingBarrier::addGradient(const ObjectShape& shape, int joint, std::vector<Vector6>& gradients) const {
  const Vector3 before = shape.point(joint + 1) - shape.point(joint);
  const Vector3 after = shape.point(joint + 2) - shape.point(joint + 1);
  const Vector3 normal = before.cross(after);
  if (normal.norm() < STRAIGHT * before.norm() * after.norm()) {
    return;
  }
  const Vector3 axis = normal.normalized();
  const Vector3 by_before = -axis.cross(before) / (before.squaredNorm() * joint_lengths_[joint]);
  const Vector3 by_after = axis.cross(after) / (after.squaredNorm() * joint_lengths_[joint]);
  shape.addPointGradient(joint, -by_before, gradients);
  shape.addPointGradient(joint + 1, by_before - by_after, gradients);
  shape.addPointGradient(joint + 2, by_after, gradients);
}

namespace barriers {

std::unique_ptr<Barrier> bending(const ParameterSection& section, const Team& team) {
  const double sharpest = 1.0 / section.number("min_radius");
  return std::make_unique<BendingBarrier>(LoadParameters::read(section, sharpest), section.numbers("joint_lengths"),
                                          team);
}

}  // namespace barriers
}  // namespace control
}  // namespace deformable_manipulation
