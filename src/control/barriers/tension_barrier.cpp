#include "deformable_manipulation/control/barriers/tension_barrier.h"

namespace deformable_manipulation {
namespace control {

double TensionBarrier::load(const ObjectShape& shape, int joint) const {
  return loads_.force(shape, joint).dot((shape.point(joint + 2) - shape.point(joint)).normalized());
}

void TensionBarrier::addGradient(const ObjectShape& shape, int joint, std::vector<Vector6>& gradients) const {
  const Vector3 along = shape.point(joint + 2) - shape.point(joint);
  const Vector3 tangent = along.normalized();
  const Vector3 pull = loads_.force(shape, joint);
  const Vector3 by_end = (pull - tangent.dot(pull) * tangent) / along.norm();
  shape.addPointGradient(joint, -by_end, gradients);
  shape.addPointGradient(joint + 2, by_end, gradients);
  loads_.addForceGradient(shape, joint, tangent, gradients);
}

namespace barriers {

std::unique_ptr<Barrier> tension(const ParameterSection& section, const Team& team) {
  const LoadParameters parameters = LoadParameters::read(section, section.number("max_tension"));
  return std::make_unique<TensionBarrier>(parameters, JointLoads(section, team), team);
}

}  // namespace barriers
}  // namespace control
}  // namespace deformable_manipulation
