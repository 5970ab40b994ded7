// Compiled once per instruction set; see lane_math.h.

#include "rod_kernel.h"

#include "rod_chain.h"
#include "rod_sweep.h"

namespace deformable_manipulation {
namespace pbd {
namespace DEFORMABLE_MANIPULATION_ISA {
namespace {

int packsFor(int copies) { return (copies + kPackWidth - 1) / kPackWidth; }

void gaussSeidel(const RodSubstepInput& input, int copies, RodLanes& lanes) {
  for (int pack = 0; pack < packsFor(copies); ++pack) {
    RodSweep sweep(input, lanes, pack * kPackWidth);
    sweep.predict();
    sweep.sweep();
  }
}

//! Solves some packs side by side: while one waits for its last result another computes.
template <int packs>
void solveChains(RodChain* chains, int joints) {
  ChainFront fronts[packs];
  ChainSolution solutions[packs];
#pragma GCC unroll 8
  for (int p = 0; p < packs; ++p) {
    fronts[p] = chains[p].begin();
  }
  for (int j = 0; j < joints; ++j) {
#pragma GCC unroll 8
    for (int p = 0; p < packs; ++p) {
      fronts[p] = chains[p].eliminate(j, fronts[p]);
    }
  }
#pragma GCC unroll 8
  for (int p = 0; p < packs; ++p) {
    solutions[p] = chains[p].solveLast(fronts[p]);
  }
  for (int j = joints - 1; j >= 0; --j) {
#pragma GCC unroll 8
    for (int p = 0; p < packs; ++p) {
      solutions[p] = chains[p].substitute(j, solutions[p]);
    }
  }
#pragma GCC unroll 8
  for (int p = 0; p < packs; ++p) {
    chains[p].moveFirst(solutions[p]);
  }
}

#ifndef TOGETHER
#define TOGETHER 1
#endif
void direct(const RodSubstepInput& input, int copies, RodLanes& lanes) {
  const int packs = packsFor(copies);
  int pack = 0;
#if TOGETHER == 2
  for (; pack + 1 < packs; pack += 2) {
    RodChain chains[2] = {{input, lanes, pack * kPackWidth}, {input, lanes, (pack + 1) * kPackWidth}};
    chains[0].predict();
    chains[1].predict();
    solveChains<2>(chains, input.segments - 1);
  }
#endif
  for (; pack < packs; ++pack) {
    RodChain chain(input, lanes, pack * kPackWidth);
    chain.predict();
    solveChains<1>(&chain, input.segments - 1);
  }
}

#define DM_TEXT(name) #name
#define DM_NAME_OF(name) DM_TEXT(name)

}  // namespace

RodKernel rodKernel() { return {DM_NAME_OF(DEFORMABLE_MANIPULATION_ISA), gaussSeidel, direct}; }

}  // namespace DEFORMABLE_MANIPULATION_ISA
}  // namespace pbd
}  // namespace deformable_manipulation
