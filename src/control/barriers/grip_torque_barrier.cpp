#include "deformable_manipulation/control/grip_barrier.h"

namespace deformable_manipulation {
namespace control {
namespace barriers {

//! Keeps the torque at each agent's grip below a limit, see GripBarrier.
std::unique_ptr<Barrier> grip_torque(const ParameterSection& section, const Team& team) {
  const LoadParameters parameters = LoadParameters::read(section, section.number("max_torque"));
  return std::make_unique<GripBarrier>(GripBarrier::Kind::TORQUE, parameters, team);
}

}  // namespace barriers
}  // namespace control
}  // namespace deformable_manipulation
