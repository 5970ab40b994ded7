#include "deformable_manipulation/control/pair_barrier.h"

namespace deformable_manipulation {
namespace control {
namespace barriers {

//! Keeps two agents apart: h = r - min_distance (paper, eqs. 11 and 12), see PairBarrier.
std::unique_ptr<Barrier> proximity(const ParameterSection& section, const Team& team) {
  return std::make_unique<PairBarrier>(PairBarrier::Kind::MINIMUM, PairParameters::read(section, team.agents), team);
}

}  // namespace barriers
}  // namespace control
}  // namespace deformable_manipulation
