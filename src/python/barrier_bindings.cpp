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

//! A barrier with the number of assistants whose velocities its rows are of.
template <typename Barrier>
struct Bound {
  Barrier barrier;
  std::size_t commanded;

  ConstraintRows noRows() const {
    ConstraintRows rows;
    rows.clear(3 * static_cast<int>(commanded));
    return rows;
  }
};

using BoundPair = Bound<PairBarrier>;
using BoundCollision = Bound<CollisionBarrier>;

BoundCollision makeCollision(std::vector<int> commanded, std::vector<int> assistants, double offset,
                             const Slopes& alpha, const Slopes& anticipation, double margin, double speed_margin,
                             double band, double max_velocity, const Formulation& formulation) {
  CollisionParameters parameters;
  parameters.offset = offset;
  parameters.margin = margin;
  parameters.speed_margin = speed_margin;
  parameters.band = band;
  parameters.alpha = {alpha.first, alpha.second};
  parameters.anticipation = {anticipation.first, anticipation.second};
  const std::size_t count = commanded.size();
  return {{std::move(commanded), std::move(assistants), parameters, max_velocity, formulation}, count};
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
  py::class_<BoundPair>(
      module, "PairBarrier",
      "Barrier on the distances between the held points of the commanded assistants and of all others,\n"
      "'overstretch' or 'proximity'; limits (A, A) [m], margin [m], slopes of alpha [1/s].")
      .def(py::init([](const std::string& kind, const std::vector<int>& commanded, int leader,
                       const Eigen::MatrixXd& limits, const Slopes& alpha, double margin, bool shares) {
             const PiecewiseLinearClassK slopes(alpha.first, alpha.second);
             return BoundPair{{toKind(kind), commanded, leader, limits, margin, slopes, shares}, commanded.size()};
           }),
           py::arg("kind"), py::arg("commanded"), py::arg("leader"), py::arg("limits"), py::arg("alpha"),
           py::arg("margin") = 0.0, py::arg("shares") = true)
      .def(
          "value",
          [](const BoundPair& bound, const std::vector<Vector3>& positions, int agent, int other) {
            return bound.barrier.value(positions, agent, other);
          },
          py::arg("positions"), py::arg("agent"), py::arg("other"), "h [m] between two agents.")
      .def(
          "lowest",
          [](const BoundPair& bound, const std::vector<Vector3>& positions, int agent) {
            return bound.barrier.lowest(positions, agent);
          },
          py::arg("positions"), py::arg("agent"), "The least h [m] of an agent.")
      .def(
          "gradient",
          [](const BoundPair& bound, const std::vector<Vector3>& positions, int agent, int other) {
            return bound.barrier.gradient(positions, agent, other);
          },
          py::arg("positions"), py::arg("agent"), py::arg("other"), "dh / d held point of the agent (3,).")
      .def(
          "rows",
          [](const BoundPair& bound, const Situation& situation) {
            ConstraintRows rows = bound.noRows();
            bound.barrier.addRows(situation, rows);
            return rows;
          },
          py::arg("situation"), "One constraint for each pair of agents of which one is commanded.");
  py::class_<BoundCollision>(
      module, "CollisionBarrier",
      "Barrier on the distances of features to obstacles; offset, margin, band [m], speed_margin\n"
      "[s], max_velocity [m/s], slopes of alpha and anticipation [1/s].")
      .def(py::init(&makeCollision), py::arg("commanded"), py::arg("assistants"), py::arg("offset"),
           py::arg("alpha") = Slopes(1.0, 5.0), py::arg("anticipation") = Slopes(0.4, 5.0), py::arg("margin") = 0.0,
           py::arg("speed_margin") = 0.0, py::arg("band") = 0.1, py::arg("max_velocity") = 0.15,
           py::arg("formulation") = Formulation{})
      .def(
          "rows",
          [](const BoundCollision& bound, const Features& features, const Situation& situation) {
            ConstraintRows rows = bound.noRows();
            bound.barrier.addRows(features, situation, rows);
            return rows;
          },
          py::arg("features"), py::arg("situation"), "The constraints of each feature.");
}
