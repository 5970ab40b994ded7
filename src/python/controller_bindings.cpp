#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cmath>
#include <memory>
#include <string>

#include "control_bindings.h"
#include "deformable_manipulation/control/team_controller.h"
#include "distances_binding.h"
#include "observation_reader.h"
#include "parameter_value_from_python.h"
#include "solver_from_python.h"

namespace py = pybind11;
using namespace deformable_manipulation::control;
using deformable_manipulation::ParameterSection;
using deformable_manipulation::ParameterValue;
using deformable_manipulation::distance::MinimumDistance;
using deformable_manipulation::pbd::RestShapes;

namespace {

//! A controller with what it needs to read observations.
struct BoundController {
  TeamController controller;
  int agents;
  ObservationReader reader;

  explicit BoundController(const ControllerParameters& parameters)
      : controller(parameters), agents(parameters.team.agents) {}
};

//! The answer to an observation.
struct Answer {
  std::string fault;  // of the observation, as a clause; empty: none
  std::vector<Decision> decisions;
};

ControllerParameters toParameters(const py::dict& controller, const py::dict& team) {
  const ParameterValue controller_value = toParameterValue(controller);
  const ParameterValue team_value = toParameterValue(team);
  deformable_manipulation::pbd::ParameterCheck check;
  const ControllerParameters parameters =
      ControllerParameters::read({controller_value, "controller", check}, {team_value, "team", check});
  check.throwIfAny();
  return parameters;
}

std::unique_ptr<BoundController> makeController(const py::dict& controller, const py::dict& team,
                                                const py::object& solver) {
  auto bound = std::make_unique<BoundController>(toParameters(controller, team));
  if (!solver.is_none()) {
    bound->controller.setSolver(solverFromPython(solver));
  }
  return bound;
}

AssistantIntent toIntent(double time, bool follows, bool hears, bool coordinated, const Vector3& reference,
                         const Vector3& command, const Vector3& acceleration, const Vector3& departure,
                         const Vector3& angular_command, const Vector3& angular_acceleration,
                         const Vector3& angular_departure) {
  for (const Vector3* vector :
       {&reference, &command, &acceleration, &departure, &angular_command, &angular_acceleration, &angular_departure}) {
    if (!vector->allFinite()) {
      throw py::value_error("an intent has a number that is not finite");
    }
  }
  if (!std::isfinite(time)) {
    throw py::value_error("the time of an intent is not finite");
  }
  return {time,         follows,   hears,           coordinated,          reference,        command,
          acceleration, departure, angular_command, angular_acceleration, angular_departure};
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
    return py::cast(Answer{fault, bound.controller.wait()});
  }
  const std::string turning = bound.controller.turningFault(bound.reader.view());
  if (!turning.empty()) {
    return py::cast(Answer{turning, bound.controller.wait()});
  }
  if (bound.controller.isAnswered(bound.reader.view().time)) {
    return py::none();
  }
  return py::cast(Answer{"", bound.controller.update(bound.reader.view())});
}

void takeReference(BoundController& bound, int member, const py::object& observation) {
  const std::string fault = bound.reader.read(observation, bound.agents);
  if (!fault.empty()) {
    throw py::value_error(fault);
  }
  bound.controller.takeReference(checked(bound, member), bound.reader.view());
}

std::vector<double> margins(BoundController& bound, int member, const py::object& observation) {
  const std::string fault = bound.reader.read(observation, bound.agents);
  if (!fault.empty()) {
    throw py::value_error(fault);
  }
  const ObservationView& view = bound.reader.view();
  PresentState state{{}, view.distances->minimum[0], presentShape(view)};
  for (int agent = 0; agent < view.agents; ++agent) {
    state.positions.push_back(view.position(agent));
  }
  return bound.controller.margins(checked(bound, member), state);
}

//! A vector of a decision or an intent as a new array.
template <typename Owner>
auto vector(Vector3 Owner::*member) {
  return [member](const Owner& owner) { return py::array_t<double>(3, (owner.*member).data()); };
}

void bindIntent(py::module_& module) {
  py::class_<AssistantIntent>(
      module, "AssistantIntent",
      "How an assistant goes on from the state of a time [s]: whether it follows, whether it hears all others, "
      "whether\n"
      "the command was decided together, its place relative to the leader [m], its command [m/s], acceleration "
      "[m/s^2]\n"
      "and departure from its goal [m/s], each (3,), and the last three of its grip [rad/s, rad/s^2, rad/s]. Raises\n"
      "ValueError for numbers that are not finite.")
      .def(py::init(&toIntent), py::kw_only(), py::arg("time"), py::arg("follows"), py::arg("hears"),
           py::arg("coordinated"), py::arg("reference"), py::arg("command"), py::arg("acceleration"),
           py::arg("departure"), py::arg("angular_command") = Vector3::Zero().eval(),
           py::arg("angular_acceleration") = Vector3::Zero().eval(),
           py::arg("angular_departure") = Vector3::Zero().eval())
      .def_readonly("time", &AssistantIntent::time)
      .def_readonly("follows", &AssistantIntent::follows)
      .def_readonly("hears", &AssistantIntent::hears)
      .def_readonly("coordinated", &AssistantIntent::coordinated)
      .def_property_readonly("reference", vector(&AssistantIntent::reference))
      .def_property_readonly("command", vector(&AssistantIntent::command))
      .def_property_readonly("acceleration", vector(&AssistantIntent::acceleration))
      .def_property_readonly("departure", vector(&AssistantIntent::departure))
      .def_property_readonly("angular_command", vector(&AssistantIntent::angular_command))
      .def_property_readonly("angular_acceleration", vector(&AssistantIntent::angular_acceleration))
      .def_property_readonly("angular_departure", vector(&AssistantIntent::angular_departure));
}

std::shared_ptr<MinimumDistance> nativeOf(const std::shared_ptr<NamedMinimumDistance>& distance) {
  if (distance == nullptr) {
    throw py::value_error("distance must not be None");
  }
  return {distance, &distance->native};
}

//! A pose from its position [m] and its quaternion x, y, z, w.
Pose toPose(const Eigen::Matrix<double, 7, 1>& numbers) {
  return {numbers.head<3>(), deformable_manipulation::pbd::Quaternion(numbers.tail<4>()).normalized()};
}

void bindObstacleForecast(py::module_& module) {
  using PoseRows = Eigen::Matrix<double, Eigen::Dynamic, 7, Eigen::RowMajor>;
  py::class_<ObstacleForecast>(module, "ObstacleForecast",
                               "An obstacle on a path. distance: _distance.MinimumDistance from it alone, at the pose\n"
                               "place (7,): m, quaternion x, y, z, w; poses (K, 7): of its origin, `step` [s] apart,\n"
                               "the first at the time `begin` [s]. Raises ValueError.")
      .def(py::init([](const std::shared_ptr<NamedMinimumDistance>& distance, const Eigen::Matrix<double, 7, 1>& place,
                       double begin, double step, const PoseRows& poses) {
             PosePath path{begin, step, {}};
             for (Eigen::Index k = 0; k < poses.rows(); ++k) {
               path.poses.push_back(toPose(poses.row(k)));
             }
             return ObstacleForecast(nativeOf(distance), toPose(place), std::move(path));
           }),
           py::arg("distance"), py::arg("place"), py::arg("begin"), py::arg("step"), py::arg("poses"));
  py::class_<MeasuredObstacle>(
      module, "MeasuredObstacle",
      "An obstacle whose poses are measured. distance, place: as of ObstacleForecast; index: of its\n"
      "pose among those of an observation.")
      .def(py::init([](const std::shared_ptr<NamedMinimumDistance>& distance, const Eigen::Matrix<double, 7, 1>& place,
                       int index) {
             const PosePath standing{0.0, 1.0, {toPose(place)}};
             return MeasuredObstacle(ObstacleForecast(nativeOf(distance), toPose(place), standing), index);
           }),
           py::arg("distance"), py::arg("place"), py::arg("index"));
}

void bindDecision(py::module_& module) {
  py::class_<Decision>(module, "Decision", "What control.decision.Decision is made of; h and slack by barrier.")
      .def_property_readonly("status", [](const Decision& d) { return static_cast<int>(d.status); })
      .def_readonly("enabled", &Decision::enabled)
      .def_readonly("coordinated", &Decision::coordinated)
      .def_property_readonly("detour", [](const Decision& d) { return static_cast<int>(d.detour); })
      .def_readonly("lacks_copies", &Decision::lacks_copies)
      .def_property_readonly("command", vector(&Decision::command))
      .def_property_readonly("nominal", vector(&Decision::nominal))
      .def_property_readonly("angular_command", vector(&Decision::angular_command))
      .def_property_readonly("angular_nominal", vector(&Decision::angular_nominal))
      .def_property_readonly("orientation_error", vector(&Decision::orientation_error))
      .def_property_readonly("position", vector(&Decision::position))
      .def_property_readonly("target", vector(&Decision::target))
      .def_property_readonly("jacobian", vector(&Decision::jacobian))
      .def_readonly("distance", &Decision::distance)
      .def_readonly("h", &Decision::h)
      .def_readonly("exact_jacobian", &Decision::exact_jacobian)
      .def_readonly("leader_drift", &Decision::leader_drift)
      .def_readonly("rows", &Decision::rows)
      .def_readonly("slack", &Decision::slack)
      .def_readonly("solve_time", &Decision::solve_time);
  py::class_<Answer>(module, "Answer", "What is wrong with an observation, if anything, and the decisions.")
      .def_readonly("fault", &Answer::fault)
      .def_readonly("decisions", &Answer::decisions);
}

}  // namespace

void bindController(py::module_& module) {
  bindDecision(module);
  bindObstacleForecast(module);
  bindIntent(module);
  py::class_<BoundController>(
      module, "TeamController",
      "The safe velocity controller of one or several assistants, which go by their numbers in the team. controller:\n"
      "dict, the section of the resolved scenario with what its barriers derive from the object; team: dict; see\n"
      "control.parameters, which makes both. Raises ValueError for parameters that cannot be used.")
      .def(py::init(&makeController), py::arg("controller"), py::arg("team"), py::arg("solver") = py::none())
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
          [](BoundController& bound, const py::dict& controller, const py::dict& team) {
            bound.controller.setParameters(toParameters(controller, team));
          },
          py::arg("controller"), py::arg("team"),
          "Of the same agents and barriers; formulation, priority and solver stay. Raises ValueError.")
      .def(
          "look_ahead",
          [](BoundController& bound, std::shared_ptr<RestShapes> shapes,
             const std::shared_ptr<NamedMinimumDistance>& standing, std::vector<ObstacleForecast> moving,
             std::vector<MeasuredObstacle> measured, const py::object& triangles) {
            std::vector<std::array<int, 3>> faces;
            if (!triangles.is_none()) {
              faces = triangles.cast<std::vector<std::array<int, 3>>>();
            }
            bound.controller.setForecast(std::make_shared<ObjectForecast>(
                std::move(shapes), nativeOf(standing), std::move(moving), std::move(measured), std::move(faces)));
          },
          py::arg("shapes"), py::arg("standing"), py::arg("moving"), py::arg("measured"), py::arg("triangles"),
          "Looks ahead with _pbd.RestShapes, a _distance.MinimumDistance of its own from the obstacles that stand, "
          "and\n"
          "ObstacleForecasts and MeasuredObstacles of the others.")
      .def(
          "find_detours",
          [](BoundController& bound, int member, std::shared_ptr<RestShapes> shapes,
             const std::shared_ptr<NamedMinimumDistance>& distance) {
            if (shapes == nullptr) {
              throw py::value_error("shapes must not be None");
            }
            bound.controller.setDetour(checked(bound, member), DetourSearch(std::move(shapes), nativeOf(distance)));
          },
          py::arg("member"), py::arg("shapes"), py::arg("distance"),
          "Lets an own assistant look for ways around, with _pbd.RestShapes of its own and a "
          "_distance.MinimumDistance.")
      .def("reset", [](BoundController& bound) { bound.controller.reset(); })
      .def("take_reference", &takeReference, py::arg("member"), py::arg("observation"), "Raises ValueError.")
      .def(
          "set_trusting", [](BoundController& bound, bool trusting) { bound.controller.setTrusting(trusting); },
          py::arg("trusting"), "Whether the others are taken to go on as expected while nothing is heard of them.")
      .def(
          "intent",
          [](const BoundController& bound, int member) { return bound.controller.intent(checked(bound, member)); },
          py::arg("member"), "The AssistantIntent of an own assistant.")
      .def(
          "hear",
          [](BoundController& bound, int member, const AssistantIntent& intent) {
            bound.controller.hear(checked(bound, member), intent);
          },
          py::arg("member"), py::arg("intent"), "Takes in the AssistantIntent of another controller's assistant.")
      .def("update", &update, py::arg("observation"),
           "The Answer to an observation; None if the state is not newer than the last one.")
      .def(
          "wait", [](BoundController& bound) { return bound.controller.wait(); }, "Decisions to stand still.")
      .def("margins", &margins, py::arg("member"), py::arg("observation"),
           "The least h of each barrier for an assistant in an observed state. Raises ValueError.");
}
