// The C++ core for Python: deformable_manipulation._pbd

#include "bindings.h"

PYBIND11_MODULE(_pbd, module) {
  using namespace deformable_manipulation::pbd;
  module.doc() = "Position-based dynamics of deformable objects and their perturbed copies (C++ core).";
  bindErrors(module);
  bindBody(module);
  bindRod(module);
  bindEquilibrium(module);
  bindFabric(module);
  bindSimulation(module);
}
