#include <cstdlib>
#include <string>

#include "rod_equilibrium_kernel.h"
#include "rod_kernel.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

RodKernel select() {
  const std::vector<RodKernel> kernels = availableRodKernels();
  const char* wanted = std::getenv("DEFORMABLE_MANIPULATION_INSTRUCTION_SET");
  if (wanted != nullptr) {
    for (const RodKernel& kernel : kernels) {
      if (kernel.instruction_set == std::string(wanted)) {
        return kernel;
      }
    }
  }
  return kernels.back();
}

}  // namespace

RodLanes::RodLanes(int segments)
    : position(3 * kLanes * segments),
      previous_position(3 * kLanes * segments),
      velocity(3 * kLanes * segments),
      orientation(4 * kLanes * segments),
      previous_orientation(4 * kLanes * segments),
      angular_velocity(3 * kLanes * segments),
      multiplier(6 * kLanes * (segments - 1)) {}

std::vector<RodKernel> availableRodKernels() {
  std::vector<RodKernel> kernels = {portable::rodKernel()};
#ifdef DEFORMABLE_MANIPULATION_X86_KERNELS
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    kernels.push_back(avx2::rodKernel());
  }
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) {
    kernels.push_back(avx512::rodKernel());
  }
#endif
  return kernels;
}

const RodKernel& selectedRodKernel() {
  static const RodKernel kernel = select();
  return kernel;
}

RodEquilibriumKernel selectedRodEquilibriumKernel() {
#ifdef DEFORMABLE_MANIPULATION_X86_KERNELS
  const std::string instruction_set = selectedRodKernel().instruction_set;
  if (instruction_set == "avx512") {
    return avx512::rodEquilibriumKernel();
  }
  if (instruction_set == "avx2") {
    return avx2::rodEquilibriumKernel();
  }
#endif
  return portable::rodEquilibriumKernel();
}

}  // namespace pbd
}  // namespace deformable_manipulation
