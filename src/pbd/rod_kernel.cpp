// Compiled once per instruction set; see lane_math.h.

#include "rod_kernel.h"

#include "rod_chain.h"
#include "rod_sweep.h"

namespace deformable_manipulation {
namespace pbd {
namespace DEFORMABLE_MANIPULATION_ISA {
namespace {

template <typename Solver>
void solvePacks(const RodSubstepInput& input, int copies, RodLanes& lanes) {
  for (int lane = 0; lane < copies; lane += kPackWidth) {
    Solver(input, lanes, lane).substep();
  }
}

template <template <bool viscous, bool plain> class Solver>
void substep(const RodSubstepInput& input, int copies, RodLanes& lanes) {
  if (input.viscous) {
    (input.plain ? solvePacks<Solver<true, true>> : solvePacks<Solver<true, false>>)(input, copies, lanes);
  } else {
    (input.plain ? solvePacks<Solver<false, true>> : solvePacks<Solver<false, false>>)(input, copies, lanes);
  }
}

#define DM_TEXT(name) #name
#define DM_NAME_OF(name) DM_TEXT(name)

}  // namespace

RodKernel rodKernel() { return {DM_NAME_OF(DEFORMABLE_MANIPULATION_ISA), substep<RodSweep>, substep<RodChain>}; }

}  // namespace DEFORMABLE_MANIPULATION_ISA
}  // namespace pbd
}  // namespace deformable_manipulation
