#include "instruction_set.h"
#include "rod_equilibrium_kernel.h"
#include "rod_kernel.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

RodKernel kernelFor(InstructionSet instruction_set) {
#ifdef DEFORMABLE_MANIPULATION_X86_KERNELS
  if (instruction_set == InstructionSet::AVX512) {
    return avx512::rodKernel();
  }
  if (instruction_set == InstructionSet::AVX2) {
    return avx2::rodKernel();
  }
#endif
  (void)instruction_set;
  return portable::rodKernel();
}

}  // namespace

RodLanes::RodLanes(int segments)
    : position(3 * kLanes * segments),
      previous_position(3 * kLanes * segments),
      velocity(3 * kLanes * segments),
      orientation(4 * kLanes * segments),
      previous_orientation(4 * kLanes * segments),
      angular_velocity(3 * kLanes * segments),
      multiplier(6 * kLanes * (segments - 1)),
      twist(kLanes * (segments - 1)) {}

std::vector<RodKernel> availableRodKernels() {
  std::vector<RodKernel> kernels;
  for (InstructionSet instruction_set : availableInstructionSets()) {
    kernels.push_back(kernelFor(instruction_set));
  }
  return kernels;
}

const RodKernel& selectedRodKernel() {
  static const RodKernel kernel = kernelFor(selectedInstructionSet());
  return kernel;
}

RodEquilibriumKernel selectedRodEquilibriumKernel() {
#ifdef DEFORMABLE_MANIPULATION_X86_KERNELS
  if (selectedInstructionSet() == InstructionSet::AVX512) {
    return avx512::rodEquilibriumKernel();
  }
  if (selectedInstructionSet() == InstructionSet::AVX2) {
    return avx2::rodEquilibriumKernel();
  }
#endif
  return portable::rodEquilibriumKernel();
}

}  // namespace pbd
}  // namespace deformable_manipulation
