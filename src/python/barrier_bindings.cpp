#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "control_bindings.h"
#include "deformable_manipulation/control/barrier.h"
#include "parameter_value_from_python.h"

namespace py = pybind11;
using namespace deformable_manipulation::control;
using deformable_manipulation::ParameterSection;
using deformable_manipulation::ParameterValue;

namespace {

//! A barrier with the number of assistants whose velocities its rows are of.
struct BoundBarrier {
  std::unique_ptr<Barrier> barrier;
  int commanded;
};

BoundBarrier makeBarrier(const std::string& name, const py::dict& parameters, const Team& team) {
  const auto maker = barrierMakers().find(name);
  if (maker == barrierMakers().end()) {
    throw py::value_error("there is no barrier '" + name + "'; see barrier_names()");
  }
  const ParameterValue value = toParameterValue(parameters);
  deformable_manipulation::pbd::ParameterCheck check;
  BoundBarrier bound{maker->second(ParameterSection(value, name, check), team),
                     static_cast<int>(team.commanded.size())};
  check.throwIfAny();
  return bound;
}

ConstraintRows rowsOf(const BoundBarrier& bound, const Features& features, const PredictedState& state) {
  ConstraintRows rows;
  rows.clear(3 * bound.commanded);
  BarrierRows own(rows, 0, 1);
  bound.barrier->addRows(features, state, own);
  return rows;
}

std::vector<std::string> barrierNames() {
  std::vector<std::string> names;
  for (const auto& maker : barrierMakers()) {
    names.push_back(maker.first);
  }
  return names;
}

void bindFormulation(py::module_& module) {
  py::class_<Formulation>(module, "Formulation", "What the controller takes into account beyond the paper's equations.")
      .def_static("full", &Formulation::full, "All of it.")
      .def_static("paper", &Formulation::paper, "The paper's equations 2 to 13.")
      .def_readwrite("leader_velocity", &Formulation::leader_velocity, "In the nominal law and the collision rows.")
      .def_readwrite("obstacle_velocity", &Formulation::obstacle_velocity, "In the collision rows.")
      .def_readwrite("prediction", &Formulation::prediction, "Of the state over the delay of a cycle.")
      .def_readwrite("every_feature", &Formulation::every_feature, "A row for each, not one for the minimum.")
      .def_readwrite("anticipation", &Formulation::anticipation, "A second, softer and slower row for each feature.")
      .def_readwrite("shares", &Formulation::shares, "Of constraints between assistants.")
      .def_readwrite("acceleration_limit", &Formulation::acceleration_limit, "As a constraint.")
      .def_readwrite("relaxation", &Formulation::relaxation, "By priority, where not all limits can hold.");
}

}  // namespace

void bindBarriers(py::module_& module) {
  bindFormulation(module);
  py::class_<Team>(
      module, "Team",
      "Who is commanded by one program: number of agents, indices of the leader, of all assistants and of\n"
      "the commanded ones, max_velocity [m/s], formulation.")
      .def(py::init([](int agents, int leader, std::vector<int> assistants, std::vector<int> commanded,
                       double max_velocity, const Formulation& formulation) {
             return Team{agents, leader, std::move(assistants), std::move(commanded), max_velocity, formulation};
           }),
           py::kw_only(), py::arg("agents"), py::arg("leader"), py::arg("assistants"), py::arg("commanded"),
           py::arg("max_velocity"), py::arg("formulation"));
  py::class_<PredictedState>(module, "PredictedState",
                             "Predicted motion of A agents: positions (A, 3) [m] when the command acts, velocities\n"
                             "(A, 3) [m/s], index of the leader, delay [s].")
      .def(py::init([](std::vector<Vector3> positions, std::vector<Vector3> velocities, int leader, double delay) {
             return PredictedState{std::move(positions), std::move(velocities), leader, delay};
           }),
           py::arg("positions"), py::arg("velocities"), py::arg("leader") = 0, py::arg("delay") = 0.0);
  py::class_<BoundBarrier>(module, "Barrier",
                           "A barrier by its name, with the parameters (dict) of its section, for a Team. Raises\n"
                           "ValueError.")
      .def(py::init(&makeBarrier), py::arg("name"), py::arg("parameters"), py::arg("team"))
      .def(
          "value",
          [](const BoundBarrier& bound, const std::vector<Vector3>& positions, double distance, int agent) {
            return bound.barrier->value({positions, distance}, agent);
          },
          py::arg("positions"), py::arg("distance"), py::arg("agent"),
          "The least h [m] of an agent, without margins, for held points (A, 3) [m] and a minimum distance [m].")
      .def("rows", &rowsOf, py::arg("features"), py::arg("state"),
           "Its ConstraintRows: of the kind 0 for limits, 1 for anticipation.");
  module.def("barrier_names", &barrierNames, "Of all barriers that there are.");
}
