#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <string>
#include <utility>
#include <vector>

#include "control_bindings.h"
#include "deformable_manipulation/control/collision_barrier.h"
#include "deformable_manipulation/control/pair_barrier.h"

namespace py = pybind11;
using namespace deformable_manipulation::control;
using Slopes = std::pair<double, double>;

namespace {

PairBarrier::Kind toKind(const std::string& name) {
  if (name != "overstretch" && name != "proximity") {
    throw py::value_error("kind is '" + name + "'; allowed are 'overstretch' and 'proximity'");
  }
  return name == "overstretch" ? PairBarrier::Kind::OVERSTRETCH : PairBarrier::Kind::PROXIMITY;
}

ConstraintRows noRows() {
  ConstraintRows rows;
  rows.clear(3);
  return rows;
}

CollisionBarrier makeCollision(int agent, std::vector<int> assistants, double offset, const Slopes& alpha,
                               const Slopes& anticipation, double margin, double speed_margin, double band,
                               double max_velocity, const Formulation& formulation) {
  CollisionParameters parameters;
  parameters.offset = offset;
  parameters.margin = margin;
  parameters.speed_margin = speed_margin;
  parameters.band = band;
  parameters.alpha = {alpha.first, alpha.second};
  parameters.anticipation = {anticipation.first, anticipation.second};
  return {agent, std::move(assistants), parameters, max_velocity, formulation};
}

}  // namespace

void bindBarriers(py::module_& module) {
  py::class_<Situation>(module, "Situation",
                        "Predicted motion of A agents: positions (A, 3) [m] when the command acts, velocities (A, 3)\n"
                        "[m/s], index of the leader, delay [s].")
      .def(py::init([](std::vector<Vector3> positions, std::vector<Vector3> velocities, int leader, double delay) {
             return Situation{std::move(positions), std::move(velocities), leader, delay};
           }),
           py::arg("positions"), py::arg("velocities"), py::arg("leader") = 0, py::arg("delay") = 0.0);
  py::class_<PairBarrier>(module, "PairBarrier",
                          "Barrier on the distances between an agent's held point and the others', 'overstretch' or\n"
                          "'proximity'; limits (A,) [m], margin [m], slopes of alpha [1/s].")
      .def(py::init([](const std::string& kind, int agent, int leader, std::vector<double> limits, const Slopes& alpha,
                       double margin, bool shares) {
             return PairBarrier(toKind(kind), agent, leader, std::move(limits), margin, {alpha.first, alpha.second},
                                shares);
           }),
           py::arg("kind"), py::arg("agent"), py::arg("leader"), py::arg("limits"), py::arg("alpha"),
           py::arg("margin") = 0.0, py::arg("shares") = true)
      .def("value", &PairBarrier::value, py::arg("positions"), py::arg("other"), "h [m] against another agent.")
      .def("lowest", &PairBarrier::lowest, py::arg("positions"), "The least h [m].")
      .def("gradient", &PairBarrier::gradient, py::arg("positions"), py::arg("other"), "dh / d own held point (3,).")
      .def(
          "rows",
          [](const PairBarrier& barrier, const Situation& situation) {
            ConstraintRows rows = noRows();
            barrier.addRows(situation, rows);
            return rows;
          },
          py::arg("situation"), "One constraint per other agent.");
  py::class_<CollisionBarrier>(
      module, "CollisionBarrier",
      "Barrier on the distances of features to obstacles; offset, margin, band [m], speed_margin\n"
      "[s], max_velocity [m/s], slopes of alpha and anticipation [1/s].")
      .def(py::init(&makeCollision), py::arg("agent"), py::arg("assistants"), py::arg("offset"),
           py::arg("alpha") = Slopes(1.0, 5.0), py::arg("anticipation") = Slopes(0.4, 5.0), py::arg("margin") = 0.0,
           py::arg("speed_margin") = 0.0, py::arg("band") = 0.1, py::arg("max_velocity") = 0.15,
           py::arg("formulation") = Formulation{})
      .def(
          "rows",
          [](const CollisionBarrier& barrier, const Features& features, const Situation& situation) {
            ConstraintRows rows = noRows();
            barrier.addRows(features, situation, rows);
            return rows;
          },
          py::arg("features"), py::arg("situation"), "The constraints of each feature.");
}
