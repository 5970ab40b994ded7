#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "bindings.h"
#include "deformable_manipulation/pbd/simulation.h"
#include "parameter_value_from_python.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

//! One row per agent.
template <typename Read>
Array perAgent(const Simulation& simulation, int components, Read read) {
  const int agents = static_cast<int>(simulation.agents().size());
  Array array({agents, components});
  for (int i = 0; i < agents; ++i) {
    const auto row = read(i);
    std::copy(row.data(), row.data() + components, array.mutable_data(i, 0));
  }
  return array;
}

std::unique_ptr<Simulation> makeSimulation(const Body& body, const py::list& agents, const py::list& perturbations,
                                           double time_step, int substeps, int steps_per_cycle) {
  std::vector<Agent> converted;
  for (const py::handle& item : agents) {
    const auto agent = item.cast<py::tuple>();
    const std::size_t common = 5;
    const auto [name, particle, hold, position, orientation] =
        py::tuple(agent[py::slice(0, common, 1)]).cast<std::tuple<std::string, int, std::string, Vector3, Vector4>>();
    converted.push_back({name, particle, toHold(hold), {position, toQuaternion(orientation)}});
    if (agent.size() > common) {
      converted.back().further = agent[common].cast<std::vector<int>>();
    }
  }
  std::vector<Perturbation> displaced;
  for (const py::handle& item : perturbations) {
    const auto [agent, displacement] = item.cast<std::pair<int, Vector3>>();
    displaced.push_back({agent, displacement});
  }
  std::unique_ptr<Body> own = body.clone();
  py::gil_scoped_release release;
  return std::make_unique<Simulation>(std::move(own), std::move(converted), displaced,
                                      Clock{time_step, substeps, steps_per_cycle});
}

void correct(Simulation& simulation, const py::dict& parameters) {
  const ParameterValue value = toParameterValue(parameters);
  ParameterCheck check;
  const CorrectionParameters read = CorrectionParameters::read({value, "correction", check});
  check.throwIfAny();
  simulation.correct(read);
}

std::string measure(Simulation& simulation, double time, const Array& points, const py::object& places) {
  if (points.ndim() != 2 || points.shape(1) != 3) {
    throw py::value_error("points must have the shape (K, 3)");
  }
  std::vector<MeasuredPoint> seen;
  Array along;
  if (!places.is_none()) {
    along = places.cast<Array>();
    if (along.ndim() != 1 || along.shape(0) != points.shape(0)) {
      throw py::value_error("places must have the shape (K,)");
    }
  }
  for (py::ssize_t i = 0; i < points.shape(0); ++i) {
    const double place = places.is_none() ? std::numeric_limits<double>::quiet_NaN() : along.at(i);
    seen.push_back({Vector3(points.at(i, 0), points.at(i, 1), points.at(i, 2)), place});
  }
  return simulation.measure(time, seen);
}

py::object correctionOf(const Simulation& simulation) {
  if (simulation.correction() == nullptr) {
    return py::none();
  }
  const std::vector<double>& field = simulation.correction()->field();
  Array array({static_cast<int>(field.size() / 3), 3});
  std::copy(field.begin(), field.end(), array.mutable_data());
  return array;
}

}  // namespace

void bindSimulation(py::module_& module) {
  py::class_<Simulation>(
      module, "Simulation",
      "A body carried by A velocity-controlled agents, with perturbed copies; settled at the start.\n\n"
      "Not to be used by several threads at a time.")
      .def(py::init(&makeSimulation), py::arg("body"), py::arg("agents"), py::arg("perturbations"),
           py::arg("time_step"), py::arg("substeps"), py::arg("steps_per_cycle") = 1,
           "body is copied. agents: list of (name, particle, 'clamped' or 'pinned', position (3,) [m], orientation\n"
           "(4,)[, further particles held besides]); perturbations: list of (agent index, displacement (3,) [m]). "
           "Raises ParameterError.")
      .def(
          "set_command",
          [](Simulation& simulation, int agent, const Vector3& linear, const Vector3& angular) {
            simulation.setCommand(agent, {linear, angular});
          },
          py::arg("agent"), py::arg("linear"), py::arg("angular") = Vector3::Zero().eval(),
          "Velocity (3,) [m/s] and angular velocity (3,) [rad/s] of an agent from the next advance on.")
      .def("advance", &Simulation::advance, py::call_guard<py::gil_scoped_release>(),
           "Advances by a cycle. Raises NonFiniteState.")
      .def("reset", &Simulation::reset, "Back to the settled start.")
      .def(
          "add_perturbation",
          [](Simulation& simulation, int agent, const Vector3& displacement) {
            return simulation.addPerturbation({agent, displacement});
          },
          py::arg("agent"), py::arg("displacement"), "Adds a copy while running; returns its id.")
      .def("clear_perturbations", &Simulation::clearPerturbations, py::arg("agent"),
           "Removes the copies that displace an agent.")
      .def("release", &Simulation::release, py::arg("agent"), "Lets an agent's particle go.")
      .def(
          "hold",
          [](Simulation& simulation, int agent, int particle, const std::string& type,
             const std::vector<int>& further) { simulation.hold(agent, particle, toHold(type), further); },
          py::arg("agent"), py::arg("particle"), py::arg("type") = "clamped", py::arg("further") = std::vector<int>(),
          "Grips a particle, and further ones, where they are, with an agent that holds none and is near.")
      .def(
          "set_material",
          [](Simulation& simulation, const std::map<std::string, double>& parameters) {
            simulation.setMaterial(toParameters(parameters));
          },
          py::arg("parameters"), "As Body.set_material, for resets too.")
      .def(
          "particles",
          [](const Simulation& s) {
            std::vector<int> particles;
            for (std::size_t i = 0; i < s.agents().size(); ++i) {
              particles.push_back(s.particleOf(static_cast<int>(i)));
            }
            return particles;
          },
          "The particle at the point of each agent's grip, or -1.")
      .def_property_readonly(
          "body", [](const Simulation& simulation) { return simulation.body().clone(); },
          "The object as it is now, as an independent copy.")
      .def_property_readonly(
          "rest", [](const Simulation& simulation) { return name(simulation.rest()); },
          "How the object rests at the start: stable, moving (settling was given up) or balanced (it leaves every\n"
          "shape that it settles in when it is pushed a little).")
      .def_property_readonly(
          "softness",
          [](const Simulation& simulation) {
            return simulation.body().softness(simulation.clock().time_step, simulation.clock().substeps);
          },
          "Where the substeps cannot keep the stiffness or viscosity of the material: what it comes to and what helps, "
          "as\n"
          "sentences; otherwise empty.")
      .def_property_readonly(
          "rest_warning", [](const Simulation& simulation) { return describe(simulation.rest()); },
          "Sentences on what is wrong with it and what helps; empty if it is stable.")
      .def_property_readonly("cycle", &Simulation::cycle)
      .def_property_readonly("reset_count", &Simulation::resetCount)
      .def_property_readonly("time", &Simulation::time, "Seconds since the start.")
      .def(
          "points",
          [](const Simulation& simulation, const py::object& out) {
            Array array = filled(out, {simulation.body().copyCount(), simulation.body().pointCount(), 3});
            simulation.points(array.mutable_data());
            return array;
          },
          py::arg("out") = py::none(), "Geometry points (C, P, 3) [m], corrected; see Body.points.")
      .def("correct", &correct, py::arg("parameters"),
           "From now on measured points correct where a rod is. parameters (dict): the section `correction` of a\n"
           "scenario. Raises ParameterError.")
      .def("measure", &measure, py::arg("time"), py::arg("points"), py::arg("places") = py::none(),
           "Takes over points (K, 3) [m] of the object, seen at a time [s] since the start. places (K,) [m]: how far\n"
           "along the object from its first end, nan where that is not known. Returns why they are not used, or an\n"
           "empty text.")
      .def_property_readonly("correction", &correctionOf,
                             "How far (P, 3) [m] measured points have moved those of the model, or None.")
      .def_property_readonly(
          "disagrees", [](const Simulation& s) { return s.correction() != nullptr && s.correction()->disagrees(); },
          "Whether the model and what was measured have disagreed for some time.")
      .def(
          "positions", [](const Simulation& s) { return perAgent(s, 3, [&](int i) { return s.pose(i).position; }); },
          "Held points (A, 3) [m].")
      .def(
          "orientations",
          [](const Simulation& s) { return perAgent(s, 4, [&](int i) { return s.pose(i).orientation.coeffs(); }); },
          "Orientations (A, 4) of the held particles.")
      .def(
          "velocities", [](const Simulation& s) { return perAgent(s, 3, [&](int i) { return s.twist(i).linear; }); },
          "Velocities (A, 3) [m/s] that led to this state.")
      .def(
          "wrench", [](const Simulation& s, int agent) { return toPair(s.wrench(agent)); }, py::arg("agent"),
          "Force (3,) [N] and torque (3,) [N m] that the object exerts on an agent.")
      .def(
          "response",
          [](Simulation& s) -> py::object {
            Array array({static_cast<int>(s.agents().size()), s.body().pointCount(), 3, 3});
            const ResponseStatus status = s.response(array.mutable_data());
            return status == ResponseStatus::VALID ? py::object(array) : py::object(py::str(describe(status)));
          },
          "Exact derivatives (A, P, 3, 3) of the settled object's points with respect to each agent's held point, or,\n"
          "where they are not known, a clause (str) that says why.")
      .def(
          "turning_response",
          [](const Simulation& s) -> py::object {
            Array array({static_cast<int>(s.agents().size()), s.body().pointCount(), 3, 3});
            return s.turningResponse(array.mutable_data()) ? py::object(array) : py::none();
          },
          "After a response that is known: derivatives (A, P, 3, 3) [m/rad] of the points with respect to turns about\n"
          "each held point; None: not available.")
      .def(
          "wrenches",
          [](const Simulation& s) {
            Array array({s.body().copyCount(), static_cast<int>(s.agents().size()), 6});
            s.wrenches(array.mutable_data());
            return array;
          },
          "Force [N] and torque about the held point [N m] (C, A, 6) that the object and its copies exert on all "
          "agents.")
      .def(
          "wrench_response",
          [](const Simulation& s) -> py::object {
            const int agents = static_cast<int>(s.agents().size());
            Array array({agents, 6, agents, 6});
            return s.wrenchResponse(array.mutable_data()) ? py::object(array) : py::none();
          },
          "After a response that is known: derivatives (A, 6, A, 6) of the object's wrenches with respect to each "
          "held\n"
          "point and turns about it; None: not available.")
      .def(
          "displaced_agents",
          [](const Simulation& s) {
            py::array_t<int> agents(s.body().copyCount());
            agents.mutable_at(0) = -1;
            for (int c = 1; c < s.body().copyCount(); ++c) {
              agents.mutable_at(c) = s.agentOf(s.body().copies()[c - 1].particle);
            }
            return agents;
          },
          "Index (C,) of the displaced agent of each copy; -1: none.")
      .def(
          "displacements",
          [](const Simulation& s) {
            Array displacements({s.body().copyCount(), 3});
            std::fill_n(displacements.mutable_data(), 3, 0.0);
            for (int c = 1; c < s.body().copyCount(); ++c) {
              const Vector3& present = s.body().copies()[c - 1].present;
              std::copy(present.data(), present.data() + 3, displacements.mutable_data(c, 0));
            }
            return displacements;
          },
          "Present displacements (C, 3) [m].")
      .def(
          "ready",
          [](const Simulation& s) {
            py::array_t<bool> ready(s.body().copyCount());
            ready.mutable_at(0) = true;
            for (int c = 1; c < s.body().copyCount(); ++c) {
              ready.mutable_at(c) = s.body().copies()[c - 1].ready();
            }
            return ready;
          },
          "Whether each copy (C,) has arrived at its displacement and calmed down.");
}

}  // namespace pbd
}  // namespace deformable_manipulation
