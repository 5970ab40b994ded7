#include "fabric_kernel.h"
#include "instruction_set.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

FabricKernel kernelFor(InstructionSet instruction_set) {
#ifdef DEFORMABLE_MANIPULATION_X86_KERNELS
  if (instruction_set == InstructionSet::AVX512) {
    return avx512::fabricKernel();
  }
  if (instruction_set == InstructionSet::AVX2) {
    return avx2::fabricKernel();
  }
#endif
  (void)instruction_set;
  return portable::fabricKernel();
}

}  // namespace

const FabricKernel& selectedFabricKernel() {
  static const FabricKernel kernel = kernelFor(selectedInstructionSet());
  return kernel;
}

std::vector<FabricKernel> availableFabricKernels() {
  std::vector<FabricKernel> kernels;
  for (InstructionSet instruction_set : availableInstructionSets()) {
    kernels.push_back(kernelFor(instruction_set));
  }
  return kernels;
}

}  // namespace pbd
}  // namespace deformable_manipulation
