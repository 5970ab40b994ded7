#include "deformable_manipulation/control/pair_barrier.h"

namespace deformable_manipulation {
namespace control {
namespace barriers {

//! Keeps two agents from overstretching the object: h = max_distance - r (paper, eqs. 8 to 10), see PairBarrier.
std::unique_ptr<Barrier> overstretch(const ParameterSection& section, const Team& team) {
  return std::make_unique<PairBarrier>(PairBarrier::Kind::MAXIMUM, PairParameters::read(section, team.agents), team);
}

}  // namespace barriers
}  // namespace control
}  // namespace deformable_manipulation
