#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <memory>
#include <string>

#include "control_bindings.h"
#include "deformable_manipulation/control/team_controller.h"
#include "observation_reader.h"
#include "solver_from_python.h"

namespace py = pybind11;
using namespace deformable_manipulation::control;
using Slopes = std::pair<double, double>;

namespace {

PiecewiseLinearClassK toClassK(const Slopes& slopes) { return {slopes.first, slopes.second}; }

//! A controller with what it needs to read observations.
struct BoundController {
  TeamController controller;
  int agents;
  ObservationReader reader;

  explicit BoundController(const ControllerParameters& parameters)
      : controller(parameters), agents(static_cast<int>(parameters.overstretch.limits.rows())) {}
};

py::array_t<double> toArray(const Vector3& vector) { return py::array_t<double>(3, vector.data()); }

//! Whether copies are missing, the status as a number, the fields of control.decision.Decision from `command` to
//! `rows`, the slacks, the time of the solver.
py::tuple toTuple(const Decision& d) {
  const py::tuple fields =
      py::make_tuple(toArray(d.command), toArray(d.nominal), toArray(d.position), toArray(d.target),
                     toArray(d.target - d.position), d.distance, d.h_collision, d.h_overstretch, d.h_proximity,
                     toArray(d.jacobian), d.exact_jacobian, d.leader_drift, d.rows);
  const py::tuple slacks = py::make_tuple(d.slack[0], d.slack[1], d.slack[2]);
  return py::make_tuple(d.lacks_copies, static_cast<int>(d.status), fields, slacks, d.solve_time);
}

py::list toList(const std::vector<Decision>& decisions) {
  py::list list;
  for (const Decision& decision : decisions) {
    list.append(toTuple(decision));
  }
  return list;
}

int checked(const BoundController& bound, int member) {
  if (member < 0 || member >= bound.controller.size()) {
    throw py::index_error("no commanded assistant has the number " + std::to_string(member));
  }
  return member;
}

py::object update(BoundController& bound, const py::object& observation) {
  const std::string fault = bound.reader.read(observation, bound.agents);
  if (!fault.empty()) {
    return py::make_tuple(fault, toList(bound.controller.wait()));
  }
  if (bound.controller.isAnswered(bound.reader.view().time)) {
    return py::none();
  }
  return py::make_tuple("", toList(bound.controller.update(bound.reader.view())));
}

void takeReference(BoundController& bound, int member, const py::object& observation) {
  const std::string fault = bound.reader.read(observation, bound.agents);
  if (!fault.empty()) {
    throw py::value_error(fault);
  }
  bound.controller.takeReference(checked(bound, member), bound.reader.view());
}

//! Reads a parameter by its name.
template <typename Value>
void read(const py::dict& from, const char* key, Value& to) {
  to = from[key].cast<Value>();
}

PairParameters toPair(const py::dict& given) {
  PairParameters pair;
  read(given, "limits", pair.limits);
  read(given, "margin", pair.margin);
  pair.alpha = toClassK(given["alpha"].cast<Slopes>());
  return pair;
}

CollisionParameters toCollision(const py::dict& given) {
  CollisionParameters collision;
  read(given, "offset", collision.offset);
  read(given, "margin", collision.margin);
  read(given, "speed_margin", collision.speed_margin);
  read(given, "band", collision.band);
  collision.alpha = toClassK(given["alpha"].cast<Slopes>());
  collision.anticipation = toClassK(given["anticipation"].cast<Slopes>());
  return collision;
}

ControllerParameters toParameters(const py::dict& given) {
  ControllerParameters p;
  read(given, "commanded", p.commanded);
  read(given, "leader", p.leader);
  read(given, "assistants", p.assistants);
  read(given, "references", p.references);
  read(given, "cycle_time", p.cycle_time);
  read(given, "gain", p.gain);
  read(given, "weights", p.weights);
  read(given, "max_velocity", p.max_velocity);
  read(given, "max_acceleration", p.max_acceleration);
  read(given, "smoothing", p.smoothing);
  read(given, "timeout", p.timeout);
  read(given, "exact_gradients", p.exact_gradients);
  read(given, "safety", p.safety);
  p.formulation = given["formulation"].cast<Formulation>();
  p.priority = toPriority(given["priority"].cast<std::vector<std::string>>());
  p.collision = toCollision(given["collision"].cast<py::dict>());
  p.overstretch = toPair(given["overstretch"].cast<py::dict>());
  p.proximity = toPair(given["proximity"].cast<py::dict>());
  return p;
}

std::unique_ptr<BoundController> makeController(const py::dict& given) {
  auto bound = std::make_unique<BoundController>(toParameters(given));
  if (!given["solver"].is_none()) {
    bound->controller.setSolver(solverFromPython(given["solver"]));
  }
  return bound;
}

void bindFormulation(py::module_& module) {
  py::class_<Formulation>(module, "Formulation", "What the controller takes into account beyond the paper's equations.")
      .def(py::init<>(), "All of it.")
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

void bindController(py::module_& module) {
  bindFormulation(module);
  py::class_<BoundController>(
      module, "TeamController",
      "The safe velocity controller of one or several assistants, which go by their numbers in\n"
      "the parameters; see control.team, which makes those from a scenario. Raises ValueError\n"
      "for parameters that cannot be used.")
      .def(py::init(&makeController), py::arg("parameters"))
      .def(
          "is_enabled",
          [](const BoundController& bound, int member) { return bound.controller.isEnabled(checked(bound, member)); },
          py::arg("member"))
      .def(
          "set_enabled",
          [](BoundController& bound, int member, bool enabled) {
            bound.controller.setEnabled(checked(bound, member), enabled);
          },
          py::arg("member"), py::arg("enabled"), "False answers every state with zero velocity.")
      .def(
          "set_parameters",
          [](BoundController& bound, const py::dict& given) { bound.controller.setParameters(toParameters(given)); },
          py::arg("parameters"), "Of the same agents; formulation, priority and solver stay. Raises ValueError.")
      .def("reset", [](BoundController& bound) { bound.controller.reset(); })
      .def("take_reference", &takeReference, py::arg("member"), py::arg("observation"), "Raises ValueError.")
      .def(
          "update", &update, py::arg("observation"),
          "What is wrong with the observation, and the decisions; None where the state is not newer than the last one.")
      .def("wait", [](BoundController& bound) { return toList(bound.controller.wait()); });
}
