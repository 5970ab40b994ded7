#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
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

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

//! An object's shape with the arrays that it is a view of.
struct BoundShape {
  std::vector<py::object> arrays;
  ObjectShape view;

  const double* take(const py::object& values, const std::vector<py::ssize_t>& shape, const char* name) {
    if (values.is_none()) {
      return nullptr;
    }
    const Numbers array(values);
    if (static_cast<std::size_t>(array.ndim()) != shape.size() ||
        !std::equal(shape.begin(), shape.end(), array.shape())) {
      throw py::value_error(std::string(name) + " has another shape than the held points and points demand");
    }
    arrays.push_back(array);
    return array.data();
  }
};

BoundShape makeShape(int agents, const py::array& points, const py::object& response, const py::object& wrenches,
                     const py::object& wrench_response, const py::object& turning, const py::object& orientations) {
  BoundShape bound;
  const py::ssize_t count = points.ndim() == 2 ? points.shape(0) : 0;
  bound.view.agents = agents;
  bound.view.points = static_cast<int>(count);
  bound.view.coordinates = bound.take(points, {count, 3}, "points");
  bound.view.response = bound.take(response, {agents, count, 3, 3}, "response");
  bound.view.turning = bound.take(turning, {agents, count, 3, 3}, "turning");
  bound.view.orientations = bound.take(orientations, {agents, 4}, "orientations");
  bound.view.wrenches = bound.take(wrenches, {agents, 6}, "wrenches");
  bound.view.wrench_response = bound.take(wrench_response, {agents, 6, agents, 6}, "wrench_response");
  return bound;
}

//! A barrier with the number of variables of its rows.
struct BoundBarrier {
  std::unique_ptr<Barrier> barrier;
  int variables;
};

BoundBarrier makeBarrier(const std::string& name, const py::dict& parameters, const Team& team) {
  const auto maker = barrierMakers().find(name);
  if (maker == barrierMakers().end()) {
    throw py::value_error("there is no barrier '" + name + "'; see barrier_names()");
  }
  const ParameterValue value = toParameterValue(parameters);
  deformable_manipulation::pbd::ParameterCheck check;
  BoundBarrier bound{maker->second(ParameterSection(value, name, check), team), team.variables()};
  check.throwIfAny();
  return bound;
}

ConstraintRows rowsOf(const BoundBarrier& bound, const Features& features, const PredictedState& state) {
  ConstraintRows rows;
  rows.clear(bound.variables);
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
      "the commanded ones, max_velocity [m/s], formulation; max_angular_velocity [rad/s] of grips that turn, 0: they\n"
      "do not.")
      .def(py::init([](int agents, int leader, std::vector<int> assistants, std::vector<int> commanded,
                       double max_velocity, const Formulation& formulation, double max_angular_velocity) {
             return Team{agents,       leader,      std::move(assistants),      std::move(commanded),
                         max_velocity, formulation, max_angular_velocity > 0.0, max_angular_velocity};
           }),
           py::kw_only(), py::arg("agents"), py::arg("leader"), py::arg("assistants"), py::arg("commanded"),
           py::arg("max_velocity"), py::arg("formulation"), py::arg("max_angular_velocity") = 0.0);
  py::class_<PredictedState>(module, "PredictedState",
                             "Predicted motion of A agents: positions (A, 3) [m] when the command acts, velocities\n"
                             "(A, 3) [m/s], index of the leader, delay [s].")
      .def(py::init([](std::vector<Vector3> positions, std::vector<Vector3> velocities, int leader, double delay,
                       std::vector<Vector3> angular_velocities) {
             return PredictedState{std::move(positions), std::move(velocities), std::move(angular_velocities), leader,
                                   delay};
           }),
           py::arg("positions"), py::arg("velocities"), py::arg("leader") = 0, py::arg("delay") = 0.0,
           py::arg("angular_velocities") = std::vector<Vector3>())
      .def(
          "set_shape", [](PredictedState& state, const BoundShape& shape) { state.shape = shape.view; },
          py::keep_alive<1, 2>(), py::arg("shape"), "The ObjectShape that loads depend on.");
  py::class_<BoundShape>(
      module, "ObjectShape",
      "Points (P, 3) [m] of an object held by A agents, and what is known of: response (A, P, 3, 3),\n"
      "wrenches (A, 6) [N, N m], wrench_response (A, 6, A, 6), turning (A, P, 3, 3) [m/rad], "
      "orientations (A, 4) x, y, z, w of the grips. Raises ValueError.")
      .def(py::init(&makeShape), py::arg("agents"), py::arg("points"), py::arg("response") = py::none(),
           py::arg("wrenches") = py::none(), py::arg("wrench_response") = py::none(), py::arg("turning") = py::none(),
           py::arg("orientations") = py::none());
  py::class_<BoundBarrier>(module, "Barrier",
                           "A barrier by its name, with the parameters (dict) of its section, for a Team. Raises\n"
                           "ValueError.")
      .def(py::init(&makeBarrier), py::arg("name"), py::arg("parameters"), py::arg("team"))
      .def(
          "value",
          [](const BoundBarrier& bound, const std::vector<Vector3>& positions, double distance, int agent,
             const BoundShape* shape) {
            return bound.barrier->value({positions, distance, shape != nullptr ? shape->view : ObjectShape()}, agent);
          },
          py::arg("positions"), py::arg("distance"), py::arg("agent"), py::arg("shape") = nullptr,
          "The least h of an agent, without margins, for held points (A, 3) [m], a minimum distance [m] and an\n"
          "ObjectShape.")
      .def("rows", &rowsOf, py::arg("features"), py::arg("state"),
           "Its ConstraintRows: of the kind 0 for limits, 1 for anticipation.");
  module.def("barrier_names", &barrierNames, "Of all barriers that there are.");
}
