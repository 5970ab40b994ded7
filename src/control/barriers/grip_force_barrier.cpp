#include "deformable_manipulation/control/grip_barrier.h"

namespace deformable_manipulation {
namespace control {
namespace barriers {

//! Keeps the force at each agent's grip below a limit, see GripBarrier.
std::unique_ptr<Barrier> grip_force(const ParameterSection& section, const Team& team) {
  const LoadParameters parameters = LoadParameters::read(section, section.number("max_force"));
  return std::make_unique<GripBarrier>(GripBarrier::Kind::FORCE, parameters, team);
}

}  // namespace barriers
}  // namespace control
}  // namespace deformable_manipulation
