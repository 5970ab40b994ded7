#include "deformable_manipulation/control/grip_barrier.h"

namespace deformable_manipulation {
namespace control {

double GripBarrier::load(const ObjectShape& shape, int agent) const {
  return shape.wrench(agent).segment<3>(first_).norm();
}

void GripBarrier::addGradient(const ObjectShape& shape, int agent, std::vector<Vector6>& gradients) const {
  Vector6 direction = Vector6::Zero();
  direction.segment<3>(first_) = shape.wrench(agent).segment<3>(first_).normalized();  // zero of zero
  shape.addWrenchGradient(agent, direction, gradients);
}

}  // namespace control
}  // namespace deformable_manipulation
