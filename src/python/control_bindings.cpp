// Safe velocity control for Python: deformable_manipulation._control

#include "control_bindings.h"

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>

#include "deformable_manipulation/control/announcement.h"
#include "deformable_manipulation/control/class_k.h"
#include "deformable_manipulation/control/position_filter.h"
#include "deformable_manipulation/control/velocity_estimator.h"

namespace py = pybind11;
using namespace deformable_manipulation::control;
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

namespace {

//! An estimator of positions of any shape.
struct ShapedEstimator {
  VelocityEstimator estimator;
  std::vector<py::ssize_t> shape;

  bool update(double time, const Numbers& position) {
    const Eigen::Map<const Eigen::VectorXd> flat(position.data(), position.size());
    const bool accepted = estimator.update(time, flat);
    if (accepted) {
      shape.assign(position.shape(), position.shape() + position.ndim());
    }
    return accepted;
  }

  Numbers velocity() const {
    if (!estimator.hasPosition()) {
      throw std::runtime_error("no position known yet: call update first");
    }
    return Numbers(shape, estimator.velocity().data());
  }
};

void bindEstimator(py::module_& module) {
  py::class_<ShapedEstimator>(module, "VelocityEstimator",
                              "Backward difference over the newest stamped positions, of any shape.\n\n"
                              "min_interval [s]: stamps closer than this count as the same; jump_back [s]: a stamp "
                              "older by more\nmeans that time was set back.")
      .def(py::init([](double min_interval, double jump_back) {
             return ShapedEstimator{VelocityEstimator(min_interval, jump_back), {}};
           }),
           py::arg("min_interval") = 1e-4, py::arg("jump_back") = 0.2)
      .def(
          "reset", [](ShapedEstimator& e) { e.estimator.reset(); }, "Forgets all positions.")
      .def("update", &ShapedEstimator::update, py::arg("time"), py::arg("position"),
           "Takes in a position [m] stamped with a time [s]; whether it was accepted: finite and newer than all\n"
           "before, or after a jump back.")
      .def("velocity", &ShapedEstimator::velocity,
           "Mean velocity [m/s] of the newest interval; zeros while fewer than two positions are known. Raises\n"
           "RuntimeError where none is.");
}

//! A filter of positions of any shape.
struct ShapedFilter {
  PositionFilter filter;
  std::vector<py::ssize_t> shape;

  bool update(double time, const Numbers& position) {
    const bool accepted = filter.update(time, Eigen::Map<const Eigen::VectorXd>(position.data(), position.size()));
    if (accepted) {
      shape.assign(position.shape(), position.shape() + position.ndim());
    }
    return accepted;
  }

  Numbers shaped(const Eigen::VectorXd& values) const {
    if (!filter.hasPosition()) {
      throw std::runtime_error("no position known yet: call update first");
    }
    return Numbers(shape, values.data());
  }
};

void bindFilter(py::module_& module) {
  py::class_<ShapedFilter>(module, "PositionFilter",
                           "Positions, of any shape, and velocities from noisy, delayed measurements.\n\n"
                           "time_constant [s] of its fading memory; 0 passes measurements and differences on. Raises\n"
                           "ValueError.")
      .def(py::init([](double time_constant) {
             return ShapedFilter{PositionFilter(time_constant), {}};
           }),
           py::arg("time_constant"))
      .def("update", &ShapedFilter::update, py::arg("time"), py::arg("position"),
           "Takes in positions [m] measured at a time [s]; whether they were accepted: finite, and newer than all\n"
           "before.")
      .def(
          "position", [](const ShapedFilter& f, double time) { return f.shaped(f.filter.position(time)); },
          py::arg("time"), "Positions [m] at a time, at constant velocity. Raises RuntimeError if none is known.")
      .def(
          "velocity", [](const ShapedFilter& f) { return f.shaped(f.filter.velocity()); },
          "[m/s] at the newest measurements. Raises RuntimeError if none is known.");
}

//! What makes an announcement unusable, as a clause.
std::string findIntentFault(const Numbers& times, const Numbers& positions) {
  if (times.ndim() != 1 || positions.ndim() != 2 || positions.shape(0) != times.size() || positions.shape(1) != 3) {
    return "its times and positions do not have the shapes (K,) and (K, 3)";
  }
  return findFault({static_cast<int>(times.size()), times.data(), positions.data()});
}

}  // namespace

PYBIND11_MODULE(_control, module) {
  module.doc() = "Safe velocity control of assistants (C++ core).";
  py::module_::import("deformable_manipulation._pbd");       // RestShapes
  py::module_::import("deformable_manipulation._distance");  // Distances, which observations hold
  py::class_<PiecewiseLinearClassK>(module, "PiecewiseLinearClassK",
                                    "Extended class K-infinity function: slopes [1/s] for h >= 0 and h < 0. Raises "
                                    "ValueError.")
      .def(py::init<double, double>(), py::arg("above"), py::arg("below"))
      .def("__call__", &PiecewiseLinearClassK::operator(), py::arg("h"), "alpha(h) [unit of h per second].");
  module.def(
      "find_intent_fault", &findIntentFault, py::arg("times"), py::arg("positions"),
      "What makes the leader's positions (K, 3) [m] at times (K,) [s] unusable as an announcement, as a clause;\n"
      "empty: nothing.");
  bindEstimator(module);
  bindFilter(module);
  bindQuadraticProgram(module);
  bindController(module);
  bindGradients(module);
  bindBarriers(module);
}
