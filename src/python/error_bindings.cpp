#include "bindings.h"

namespace deformable_manipulation {
namespace pbd {

void bindErrors(py::module_& module) {
  static py::exception<ParameterError> parameter_error(module, "ParameterError", PyExc_ValueError);
  parameter_error.attr("__doc__") =
      "Parameters that cannot be accepted, all at once; ``problems``: list of (key, value, allowed).";
  static py::exception<NonFiniteState> non_finite(module, "NonFiniteState", PyExc_RuntimeError);
  non_finite.attr("__doc__") = "The simulated state is no longer finite; the text names step, copy and particle.";
  py::register_exception_translator([](std::exception_ptr pointer) {
    try {
      std::rethrow_exception(std::move(pointer));
    } catch (const ParameterError& error) {
      py::list problems;
      for (const Problem& problem : error.problems()) {
        problems.append(py::make_tuple(problem.key, problem.value, problem.allowed));
      }
      py::object exception = py::reinterpret_borrow<py::object>(parameter_error)(error.what());
      exception.attr("problems") = problems;
      PyErr_SetObject(parameter_error.ptr(), exception.ptr());
    } catch (const NonFiniteState& error) {
      PyErr_SetString(non_finite.ptr(), error.what());
    }
  });
}

}  // namespace pbd
}  // namespace deformable_manipulation
