#include "deformable_manipulation/control/grip_barrier.h"

namespace deformable_manipulation {
namespace control {
namespace barriers {

//! Keeps the force at each agent's grip below its limits, see GripBarrier.
std::unique_ptr<Barrier> grip_force(const ParameterSection& section, const Team& team) {
  return std::make_unique<GripBarrier>(GripBarrier::Kind::FORCE, section, "max_force", team);
}

}  // namespace barriers
}  // namespace control
}  // namespace deformable_manipulation
