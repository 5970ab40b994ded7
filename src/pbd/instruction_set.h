#pragma once

#include <vector>

namespace deformable_manipulation {
namespace pbd {

//! What the kernels are compiled for.
enum class InstructionSet { PORTABLE, AVX2, AVX512 };

//! As in DEFORMABLE_MANIPULATION_INSTRUCTION_SET: portable, avx2, avx512.
const char* name(InstructionSet instruction_set);

//! Those that this processor runs and the kernels are compiled for, slowest first.
std::vector<InstructionSet> availableInstructionSets();

//! The fastest of them. The environment variable DEFORMABLE_MANIPULATION_INSTRUCTION_SET narrows the choice.
InstructionSet selectedInstructionSet();

}  // namespace pbd
}  // namespace deformable_manipulation
