#include "instruction_set.h"

#include <cstdlib>
#include <string>

namespace deformable_manipulation {
namespace pbd {
namespace {

InstructionSet select() {
  const std::vector<InstructionSet> available = availableInstructionSets();
  const char* wanted = std::getenv("DEFORMABLE_MANIPULATION_INSTRUCTION_SET");
  if (wanted != nullptr) {
    for (InstructionSet instruction_set : available) {
      if (name(instruction_set) == std::string(wanted)) {
        return instruction_set;
      }
    }
  }
  return available.back();
}

}  // namespace

const char* name(InstructionSet instruction_set) {
  switch (instruction_set) {
    case InstructionSet::AVX2:
      return "avx2";
    case InstructionSet::AVX512:
      return "avx512";
    default:
      return "portable";
  }
}

std::vector<InstructionSet> availableInstructionSets() {
  std::vector<InstructionSet> available = {InstructionSet::PORTABLE};
#ifdef DEFORMABLE_MANIPULATION_X86_KERNELS
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    available.push_back(InstructionSet::AVX2);
  }
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) {
    available.push_back(InstructionSet::AVX512);
  }
#endif
  return available;
}

InstructionSet selectedInstructionSet() {
  static const InstructionSet selected = select();
  return selected;
}

}  // namespace pbd
}  // namespace deformable_manipulation
