#include <pybind11/eigen.h>
#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "control_bindings.h"
#include "deformable_manipulation/control/dual_active_set.h"
#include "deformable_manipulation/control/safety_filter.h"
#include "solver_from_python.h"

namespace py = pybind11;
using namespace deformable_manipulation::control;

namespace {

//! Rows with their components known from the start.
ConstraintRows makeRows(int components) {
  ConstraintRows rows;
  rows.clear(components);
  return rows;
}

py::object solve(const Eigen::VectorXd& hessian, const Eigen::VectorXd& linear, const RowMatrix& constraints,
                 const Eigen::VectorXd& limits) {
  const Eigen::Index n = hessian.size();
  if (linear.size() != n || constraints.cols() != n || constraints.rows() != limits.size() ||
      !(hessian.array() > 0.0).all()) {
    throw py::value_error("expected hessian (n,) > 0, linear (n,), constraints (m, n), limits (m,)");
  }
  DualActiveSet solver;
  if (solver.solve({hessian, linear, constraints, limits, static_cast<int>(limits.size())}) !=
      DualActiveSet::Outcome::OPTIMAL) {
    return py::none();
  }
  return py::cast(solver.solution());
}

std::unique_ptr<SafetyFilter> makeFilter(const Eigen::VectorXd& weights, const Priority& priority, bool relaxation,
                                         const py::object& solver) {
  auto filter = std::make_unique<SafetyFilter>(weights, priority, relaxation);
  if (!solver.is_none()) {
    filter->setSolver(solverFromPython(solver));
  }
  return filter;
}

}  // namespace

QpSolver solverFromPython(const py::object& solver) {
  return [solver](const QuadraticProgram& program, Eigen::VectorXd& x) {
    const RowMatrix constraints = program.constraints.topRows(program.rows);
    const Eigen::VectorXd limits = program.limits.head(program.rows);
    const Eigen::MatrixXd hessian = program.hessian.asDiagonal();
    const py::object solution = solver(hessian, program.linear, constraints, limits);
    if (solution.is_none()) {
      return false;
    }
    x = solution.cast<Eigen::VectorXd>();
    return true;
  };
}

void bindQuadraticProgram(py::module_& module) {
  module.def(
      "solve_qp", &solve, py::arg("hessian"), py::arg("linear"), py::arg("constraints"), py::arg("limits"),
      "The x (n,) that minimises 1/2 x' diag(hessian) x + linear' x subject to constraints x >= limits, or None\n"
      "where the constraints contradict each other; hessian (n,) > 0, constraints (m, n).");
  py::class_<ConstraintRows>(module, "ConstraintRows",
                             "Constraints coefficients . u >= bound on a velocity u [m/s] of some components.")
      .def(py::init(&makeRows), py::arg("components") = 3)
      .def("__len__", &ConstraintRows::size)
      .def(
          "add",
          [](ConstraintRows& rows, int kind, const Eigen::VectorXd& coefficients, double bound) {
            if (coefficients.size() != rows.components()) {
              throw py::value_error("coefficients must have " + std::to_string(rows.components()) + " components");
            }
            rows.add(kind, bound) = coefficients;
          },
          py::arg("kind"), py::arg("coefficients"), py::arg("bound"), "Adds a row of a kind; bound in m/s.")
      .def_property_readonly(
          "kinds",
          [](const ConstraintRows& rows) {
            std::vector<int> kinds(rows.size());
            for (int row = 0; row < rows.size(); ++row) {
              kinds[row] = rows.kind(row);
            }
            return kinds;
          },
          "Of each row.")
      .def_property_readonly(
          "coefficients",
          [](const ConstraintRows& rows) {
            RowMatrix all(rows.size(), rows.components());
            for (int row = 0; row < rows.size(); ++row) {
              all.row(row) = rows.coefficients(row).transpose();
            }
            return all;
          },
          "(rows, components).")
      .def_property_readonly(
          "bounds",
          [](const ConstraintRows& rows) {
            Eigen::VectorXd bounds(rows.size());
            for (int row = 0; row < rows.size(); ++row) {
              bounds[row] = rows.bound(row);
            }
            return bounds;
          },
          "(rows,) m/s.");
  py::class_<SafetyFilter>(
      module, "SafetyFilter",
      "The velocity nearest to the nominal one that rows and bounds allow.\n\n"
      "weights gamma (n,), positive; priority: the limits' kinds 0 to L - 1, the last to yield first (kind L is\n"
      "anticipation); relaxation\n"
      "False: rows that cannot all hold fail; solver: called with the program's matrices P (n, n), "
      "q, A, b,\ngives x or None. Raises ValueError.")
      .def(py::init(&makeFilter), py::arg("weights"), py::arg("priority"), py::arg("relaxation") = true,
           py::arg("solver") = py::none())
      .def(
          "filter",
          [](SafetyFilter& filter, const Eigen::VectorXd& nominal, const ConstraintRows& rows,
             const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
            const Filtered& result = filter.filter(nominal, rows, lower, upper);
            return py::make_tuple(result.velocity, static_cast<int>(result.status), result.slack);
          },
          py::arg("nominal"), py::arg("rows"), py::arg("lower"), py::arg("upper"),
          "Velocity (n,) [m/s], status as a number of control.status.Status, slack [m/s] per kind.");
}
