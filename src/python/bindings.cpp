// The C++ core for Python: deformable_manipulation._pbd

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "deformable_manipulation/pbd/errors.h"
#include "deformable_manipulation/pbd/rod.h"
#include "deformable_manipulation/pbd/rod_equilibrium.h"
#include "deformable_manipulation/pbd/simulation.h"

namespace py = pybind11;
using namespace deformable_manipulation::pbd;
using Array = py::array_t<double, py::array::c_style>;
using Vector4 = Eigen::Vector4d;
using Shape = std::vector<py::ssize_t>;

namespace {

Quaternion toQuaternion(const Vector4& xyzw) { return Quaternion(xyzw[3], xyzw[0], xyzw[1], xyzw[2]); }

//! The array given to be filled, if it fits, or a new one.
Array filled(const py::object& out, const Shape& shape) {
  if (out.is_none()) {
    return Array(shape);
  }
  if (!py::isinstance<Array>(out)) {
    throw py::type_error("out must be a C-contiguous array of float64");
  }
  Array array = py::reinterpret_borrow<Array>(out);
  if (Shape(array.shape(), array.shape() + array.ndim()) != shape) {
    throw py::value_error("out has the wrong shape: it must be " + std::string(py::str(py::cast(shape))));
  }
  return array;
}

template <typename Value>
Value choose(const std::string& key, const std::string& given,
             const std::vector<std::pair<const char*, Value>>& choices) {
  std::string allowed;
  for (const auto& choice : choices) {
    if (given == choice.first) {
      return choice.second;
    }
    allowed += (allowed.empty() ? "" : " or ") + std::string(choice.first);
  }
  throw ParameterError({{key, "'" + given + "'", allowed}});
}

Hold toHold(const std::string& name) {
  return choose<Hold>("hold", name, {{"clamped", Hold::CLAMPED}, {"pinned", Hold::PINNED}});
}

std::unique_ptr<Rod> makeRod(double length, double radius, double density, int segments, double young_modulus,
                             double torsion_modulus, const std::string& stretch, double damping,
                             const std::string& solver, int threads, const Vector3& gravity, const Vector3& position,
                             const Vector4& orientation) {
  RodParameters p;
  p.length = length;
  p.radius = radius;
  p.density = density;
  p.segments = segments;
  p.young_modulus = young_modulus;
  p.torsion_modulus = torsion_modulus;
  p.stretch = choose<Stretch>("stretch", stretch, {{"zero", Stretch::ZERO}, {"from_moduli", Stretch::FROM_MODULI}});
  p.damping = damping;
  p.solver =
      choose<RodSolver>("solver", solver, {{"gauss_seidel", RodSolver::GAUSS_SEIDEL}, {"direct", RodSolver::DIRECT}});
  p.threads = threads;
  p.gravity = gravity;
  p.pose = {position, toQuaternion(orientation)};
  return std::make_unique<Rod>(p);
}

Array pointsOf(const Body& body, const py::object& out) {
  Array array = filled(out, {body.copyCount(), body.pointCount(), 3});
  body.points(array.mutable_data());
  return array;
}

template <typename Read>
Array particlesOf(const Body& body, int copy, int components, Read read) {
  if (copy < 0 || copy >= body.copyCount()) {
    throw py::index_error("there are copies 0 to " + std::to_string(body.copyCount() - 1));
  }
  Array array({body.particleCount(), components});
  read(array.mutable_data());
  return array;
}

std::vector<MaterialParameter> toParameters(const std::map<std::string, double>& parameters) {
  std::vector<MaterialParameter> converted;
  for (const auto& [key, value] : parameters) {
    converted.push_back({key, value});
  }
  return converted;
}

std::pair<Vector3, Vector3> toPair(const Wrench& wrench) { return {wrench.force, wrench.torque}; }

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
    const auto [name, particle, hold, position, orientation] =
        item.cast<std::tuple<std::string, int, std::string, Vector3, Vector4>>();
    converted.push_back({name, particle, toHold(hold), {position, toQuaternion(orientation)}});
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

void bindErrors(py::module_& module) {
  static py::exception<ParameterError> parameter_error(module, "ParameterError", PyExc_ValueError);
  parameter_error.attr("__doc__") =
      "Parameters that cannot be accepted, all at once; ``problems``: list of (key, value, allowed).";
  static py::exception<NonFiniteState> non_finite(module, "NonFiniteState", PyExc_RuntimeError);
  non_finite.attr("__doc__") = "The simulated state is no longer finite; the text names step, copy and particle.";
  py::register_exception_translator([](std::exception_ptr pointer) {
    try {
      std::rethrow_exception(pointer);
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

void bindBody(py::module_& module) {
  py::class_<Body>(module, "Body",
                   "A deformable object and its perturbed copies, advanced together by position-based dynamics.\n\n"
                   "C copies (copy 0 is the object itself), N particles, P geometry points. SI units, fixed frame,\n"
                   "quaternions x, y, z, w.")
      .def("clone", &Body::clone, "An independent body in the same state.")
      .def_property_readonly("particle_count", &Body::particleCount, "N, particles that can be held.")
      .def_property_readonly("point_count", &Body::pointCount, "P, geometry points per copy.")
      .def_property_readonly("copy_count", &Body::copyCount, "C, with the object itself.")
      .def_property_readonly("mass", &Body::mass, "Mass [kg].")
      .def("free_length", &Body::freeLength, py::arg("particle"), py::arg("other"),
           "Largest distance [m] between two particles of the unstretched object.")
      .def(
          "hold",
          [](Body& body, int particle, const std::string& type, const py::object& position,
             const py::object& orientation) {
            if (position.is_none() && orientation.is_none()) {
              body.hold(particle, toHold(type));
              return;
            }
            if (position.is_none() || orientation.is_none()) {
              throw py::value_error("give both position and orientation of the hold, or neither");
            }
            body.hold(particle, toHold(type), {position.cast<Vector3>(), toQuaternion(orientation.cast<Vector4>())});
          },
          py::arg("particle"), py::arg("type") = "clamped", py::arg("position") = py::none(),
          py::arg("orientation") = py::none(),
          "Holds a particle ('clamped' or 'pinned') where it is, or at a position (3,) [m] and orientation (4,).")
      .def("release", &Body::release, py::arg("particle"), "Lets a particle go; its copies are removed.")
      .def(
          "set_velocity",
          [](Body& body, int particle, const Vector3& linear, const Vector3& angular) {
            body.setTwist(particle, {linear, angular});
          },
          py::arg("particle"), py::arg("linear"), py::arg("angular") = Vector3::Zero().eval(),
          "Velocity (3,) [m/s] and angular velocity (3,) [rad/s] of a held particle from now on.")
      .def(
          "set_pose",
          [](Body& body, int particle, const Vector3& position, const Vector4& orientation) {
            body.setPose(particle, {position, toQuaternion(orientation)});
          },
          py::arg("particle"), py::arg("position"), py::arg("orientation"), "Puts a held particle at a pose at once.")
      .def("add_copy", &Body::addCopy, py::arg("particle"), py::arg("displacement"),
           "Adds a copy with a held particle displaced by (3,) [m]; returns its id. It starts as the object is\n"
           "and moves to its displacement.")
      .def("remove_copy", &Body::removeCopy, py::arg("id"), "Removes a copy.")
      .def_property_readonly(
          "copy_ids",
          [](const Body& body) {
            std::vector<int> ids;
            for (const PerturbedCopy& copy : body.copies()) {
              ids.push_back(copy.id);
            }
            return ids;
          },
          "Ids of copies 1 to C - 1, in their order.")
      .def(
          "set_material",
          [](Body& body, const std::map<std::string, double>& parameters) {
            body.setMaterial(toParameters(parameters));
          },
          py::arg("parameters"),
          "Changes the material while running: dict of parameter (as in the scenario's object) to value. Raises\n"
          "ParameterError.")
      .def("lay_out", &Body::layOut, "Places all copies, at rest, on a slack curve between the holds.")
      .def("step", &Body::step, py::arg("time_step"), py::arg("substeps"), py::call_guard<py::gil_scoped_release>(),
           "Advances by time_step [s]. Raises ParameterError, NonFiniteState.")
      .def(
          "settle",
          [](Body& body, double time_step, int substeps, double speed_tolerance, double time_limit) {
            return body.settle({time_step, substeps, speed_tolerance, time_limit});
          },
          py::arg("time_step") = 0.01, py::arg("substeps") = 2, py::arg("speed_tolerance") = 1e-4,
          py::arg("time_limit") = 60.0, py::call_guard<py::gil_scoped_release>(),
          "Advances until no particle is faster than speed_tolerance [m/s]; False if that takes longer than\n"
          "time_limit [s] of simulated time.")
      .def("points", &pointsOf, py::arg("out") = py::none(),
           "Geometry points (C, P, 3) [m]; fills `out`, an array of that shape, without allocating if given.")
      .def(
          "positions",
          [](const Body& body, int copy) {
            return particlesOf(body, copy, 3, [&](double* to) { body.positions(copy, to); });
          },
          py::arg("copy") = 0, "Particle positions (N, 3) [m] of a copy.")
      .def(
          "velocities",
          [](const Body& body, int copy) {
            return particlesOf(body, copy, 3, [&](double* to) { body.velocities(copy, to); });
          },
          py::arg("copy") = 0, "Particle velocities (N, 3) [m/s] of a copy.")
      .def(
          "orientations",
          [](const Body& body, int copy) {
            return particlesOf(body, copy, 4, [&](double* to) { body.orientations(copy, to); });
          },
          py::arg("copy") = 0, "Particle orientations (N, 4) of a copy (rods).")
      .def(
          "wrench", [](const Body& body, int particle) { return toPair(body.wrench(particle)); }, py::arg("particle"),
          "Force (3,) [N] and torque (3,) [N m] about the held point that the object exerts on its agent.");

  py::class_<Rod, Body>(module, "Rod",
                        "A rope or rod of rigid segments with zero-stretch bending-twisting joints (Deul et al. 2018)\n"
                        "and small substeps. The particles are the segments, the points their N + 1 ends.\n\n"
                        "length, radius [m], density [kg/m^3], young_modulus, torsion_modulus [Pa], damping [1/s] of\n"
                        "motion relative to the held points, gravity (3,) [m/s^2]; stretch 'zero' or 'from_moduli';\n"
                        "solver 'direct' or 'gauss_seidel'; threads that advance the copies, eight each. Undeformed it "
                        "lies along the x axis of the pose given by\n"
                        "position (3,) [m] and orientation (4,). Raises ParameterError.")
      .def(py::init(&makeRod), py::kw_only(), py::arg("length"), py::arg("radius"), py::arg("density"),
           py::arg("segments"), py::arg("young_modulus"), py::arg("torsion_modulus"), py::arg("stretch") = "zero",
           py::arg("damping") = 10.0, py::arg("solver") = "direct", py::arg("threads") = 1,
           py::arg("gravity") = Vector3(0.0, 0.0, -9.81), py::arg("position") = Vector3::Zero().eval(),
           py::arg("orientation") = Vector4(0.0, 0.0, 0.0, 1.0));
}

void requireCopy(const RodEquilibrium& equilibrium, int copy) {
  if (copy < 0 || copy >= equilibrium.copyCount()) {
    throw py::index_error("the equilibria of " + std::to_string(equilibrium.copyCount()) + " copies are known");
  }
}

//! An equilibrium with the sizes of the rod that it was found for.
struct BoundEquilibrium {
  RodEquilibrium equilibrium;
  int holds = 0;
  int points = 0;

  void update(const Rod& rod, int copies, double tolerance, int iterations) {
    if (copies < 1 || copies > rod.copyCount()) {
      throw py::value_error("copies is " + std::to_string(copies) + "; it must be 1 to " +
                            std::to_string(rod.copyCount()));
    }
    if (!(tolerance > 0.0 && tolerance <= 0.01)) {
      throw py::value_error("tolerance is " + std::to_string(tolerance) + "; it must be > 0 and <= 0.01");
    }
    if (iterations < 1 || iterations > 1000) {
      throw py::value_error("iterations is " + std::to_string(iterations) + "; it must be 1 to 1000");
    }
    holds = static_cast<int>(rod.holds().size());
    points = rod.pointCount();
    equilibrium.update(rod, copies, {tolerance, iterations});
  }
};

void bindEquilibrium(py::module_& module) {
  py::class_<BoundEquilibrium>(
      module, "RodEquilibrium",
      "The quasi-static equilibrium of a rod's copies by Newton's method, and its exact derivative with respect to\n"
      "each held point by implicit differentiation. Each update starts from the last one.")
      .def(py::init<>())
      .def("update", &BoundEquilibrium::update, py::arg("rod"), py::arg("copies") = 1, py::arg("tolerance") = 1e-5,
           py::arg("iterations") = 20, py::call_guard<py::gil_scoped_release>(),
           "Finds the equilibria of the first copies at their present holds. tolerance: of the last Newton step,\n"
           "turns [rad] and relative forces.")
      .def_property_readonly(
          "iterations", [](const BoundEquilibrium& e) { return e.equilibrium.iterations(); },
          "Newton steps of the last update.")
      .def(
          "valid",
          [](const BoundEquilibrium& e, int copy) {
            requireCopy(e.equilibrium, copy);
            return e.equilibrium.status(copy) == ResponseStatus::VALID;
          },
          py::arg("copy") = 0, "Whether the equilibrium of a copy was found.")
      .def(
          "status",
          [](const BoundEquilibrium& e, int copy) {
            requireCopy(e.equilibrium, copy);
            return describe(e.equilibrium.status(copy));
          },
          py::arg("copy") = 0, "'valid', or why the equilibrium of a copy is not known.")
      .def(
          "points",
          [](const BoundEquilibrium& e, int copy) {
            requireCopy(e.equilibrium, copy);
            Array array({e.points, 3});
            e.equilibrium.points(copy, array.mutable_data());
            return array;
          },
          py::arg("copy") = 0, "Points (P, 3) [m] of a copy in equilibrium.")
      .def(
          "response",
          [](const BoundEquilibrium& e, int copy) {
            requireCopy(e.equilibrium, copy);
            Array array({e.holds, e.points, 3, 3});
            e.equilibrium.response(copy, array.mutable_data());
            return array;
          },
          py::arg("copy") = 0, "d point / d held point, (H, P, 3, 3), holds in the order of their particles.");
}

void bindSimulation(py::module_& module) {
  py::class_<Simulation>(
      module, "Simulation",
      "A body carried by A velocity-controlled agents, with perturbed copies; settled at the start.\n\n"
      "Not to be used by several threads at a time.")
      .def(py::init(&makeSimulation), py::arg("body"), py::arg("agents"), py::arg("perturbations"),
           py::arg("time_step"), py::arg("substeps"), py::arg("steps_per_cycle") = 1,
           "body is copied. agents: list of (name, particle, 'clamped' or 'pinned', position (3,) [m], orientation\n"
           "(4,)); perturbations: list of (agent index, displacement (3,) [m]). Raises ParameterError.")
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
          [](Simulation& simulation, int agent, int particle, const std::string& type) {
            simulation.hold(agent, particle, toHold(type));
          },
          py::arg("agent"), py::arg("particle"), py::arg("type") = "clamped",
          "Grips a particle, where it is, with an agent that holds none and is near.")
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
          "The particle that each agent holds, or -1.")
      .def_property_readonly(
          "body", [](const Simulation& simulation) { return simulation.body().clone(); },
          "The object as it is now, as an independent copy.")
      .def_property_readonly("settled", &Simulation::settled, "False if settling was given up.")
      .def_property_readonly("cycle", &Simulation::cycle)
      .def_property_readonly("reset_count", &Simulation::resetCount)
      .def_property_readonly("time", &Simulation::time, "Seconds since the start.")
      .def(
          "points",
          [](const Simulation& simulation, const py::object& out) { return pointsOf(simulation.body(), out); },
          py::arg("out") = py::none(), "Geometry points (C, P, 3) [m]; see Body.points.")
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

}  // namespace

PYBIND11_MODULE(_pbd, module) {
  module.doc() = "Position-based dynamics of deformable objects and their perturbed copies (C++ core).";
  bindErrors(module);
  bindBody(module);
  bindEquilibrium(module);
  bindSimulation(module);
}
