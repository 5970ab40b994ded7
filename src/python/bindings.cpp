// The C++ core for Python: deformable_manipulation._pbd

#include "bindings.h"

#include "../pbd/instruction_set.h"

PYBIND11_MODULE(_pbd, module) {
  using namespace deformable_manipulation::pbd;
  module.doc() = "Position-based dynamics of deformable objects and their perturbed copies (C++ core).";
  bindErrors(module);
  bindRestShapes(module);
  bindBody(module);
  bindRod(module);
  bindEquilibrium(module);
  bindFabric(module);
  bindSimulation(module);
  module.def(
      "instruction_set", [] { return name(selectedInstructionSet()); },
      "What the kernels run on in this process: portable, avx2 or avx512. The environment variable\n"
      "DEFORMABLE_MANIPULATION_INSTRUCTION_SET chooses it at the start.");
}
