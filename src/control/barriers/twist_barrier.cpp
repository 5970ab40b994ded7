#include "deformable_manipulation/control/barriers/twist_barrier.h"

namespace deformable_manipulation {
namespace control {
namespace {

Vector3 segmentOf(const ObjectShape& shape, int i) { return shape.point(i + 1) - shape.point(i); }

}  // namespace

//! [rad/m] Positive where the second segment is turned forwards about the rod.
double TwistBarrier::twist(const ObjectShape& shape, int joint) const {
  const Vector3 directions = segmentOf(shape, joint).normalized() + segmentOf(shape, joint + 1).normalized();
  return loads_.moment(shape, joint).dot(directions) / (2.0 * stiffness_);
}

void TwistBarrier::addGradient(const ObjectShape& shape, int joint, std::vector<Vector6>& gradients) const {
  const double scale = std::copysign(0.5 / stiffness_, twist(shape, joint));
  const Vector3 moment = loads_.moment(shape, joint);
  Vector3 directions = Vector3::Zero();
  for (const int segment : {joint, joint + 1}) {
    const Vector3 along = segmentOf(shape, segment).normalized();
    const Vector3 by_end = scale * (moment - along.dot(moment) * along) / segmentOf(shape, segment).norm();
    shape.addPointGradient(segment, -by_end, gradients);
    shape.addPointGradient(segment + 1, by_end, gradients);
    directions += along;
  }
  loads_.addMomentGradient(shape, joint, scale * directions, gradients);
}

namespace barriers {

std::unique_ptr<Barrier> twist(const ParameterSection& section, const Team& team) {
  const LoadParameters parameters = LoadParameters::read(section, section.number("max_twist"));
  return std::make_unique<TwistBarrier>(parameters, JointLoads(section, team), section.number("torsion_stiffness"),
                                        team);
}

}  // namespace barriers
}  // namespace control
}  // namespace deformable_manipulation
