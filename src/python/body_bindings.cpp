// Arguments and results that all bodies share, and the body itself.

#include <algorithm>

#include "bindings.h"
#include "deformable_manipulation/pbd/object_kinds.h"
#include "parameter_value_from_python.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

template <typename Read>
Array particlesOf(const Body& body, int copy, int components, Read read) {
  if (copy < 0 || copy >= body.copyCount()) {
    throw py::index_error("there are copies 0 to " + std::to_string(body.copyCount() - 1));
  }
  Array array({body.particleCount(), components});
  read(array.mutable_data());
  return array;
}

}  // namespace

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

Hold toHold(const std::string& name) {
  return choose<Hold>("hold", name, {{"clamped", Hold::CLAMPED}, {"pinned", Hold::PINNED}});
}

Array pointsOf(const Body& body, const py::object& out) {
  Array array = filled(out, {body.copyCount(), body.pointCount(), 3});
  body.points(array.mutable_data());
  return array;
}

std::vector<MaterialParameter> toParameters(const std::map<std::string, double>& parameters) {
  std::vector<MaterialParameter> converted;
  converted.reserve(parameters.size());
  for (const auto& [key, value] : parameters) {
    converted.push_back({key, value});
  }
  return converted;
}

std::unique_ptr<Body> makeBodyOf(const py::dict& object, const py::dict& simulation) {
  const ParameterValue object_value = toParameterValue(object);
  const ParameterValue simulation_value = toParameterValue(simulation);
  ParameterCheck check;
  return makeBody({object_value, "object", check}, {simulation_value, "simulation", check});
}

void bindBody(py::module_& module) {
  py::class_<Body>(module, "Body",
                   "A deformable object and its perturbed copies, advanced together by position-based dynamics.\n\n"
                   "C copies (copy 0 is the object itself), N particles, P geometry points. SI units, fixed frame,\n"
                   "quaternions x, y, z, w.")
      .def_property_readonly("kind", &Body::kind, "The word that says its kind in the scenario: 'rod' or 'fabric'.")
      .def(
          "rest_shapes",
          [](const Body& body, const py::list& agents) -> std::shared_ptr<RestShapes> {
            std::vector<HeldPoint> held;
            for (const py::handle& item : agents) {
              const auto [particle, type, position, orientation] =
                  item.cast<std::tuple<int, std::string, Vector3, Vector4>>();
              held.push_back({particle, toHold(type), {position, toQuaternion(orientation)}, {}});
            }
            return body.restShapes(held);
          },
          py::arg("agents"),
          "How the object, which is held nowhere, rests between agents, a list of (particle, 'clamped' or 'pinned',\n"
          "position (3,) [m], orientation (4,)); None for objects of a kind that cannot tell.")
      .def("clone", &Body::clone, "An independent body in the same state.")
      .def_property_readonly("particle_count", &Body::particleCount, "N, particles that can be held.")
      .def_property_readonly("point_count", &Body::pointCount, "P, geometry points per copy.")
      .def_property_readonly("copy_count", &Body::copyCount, "C, with the object itself.")
      .def_property_readonly("mass", &Body::mass, "Mass [kg].")
      .def_property_readonly("stretch", &Body::stretch, "Relative error of the object's own length or size.")
      .def(
          "softness", &Body::softness, py::arg("time_step"), py::arg("substeps"),
          "Where substeps cannot keep the stiffness or viscosity of the material: what it comes to and what helps, as\n"
          "sentences; otherwise empty.")
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
      .def(
          "move_to",
          [](Body& body, int particle, const Vector3& position, const Vector4& orientation, double duration) {
            body.moveTo(particle, {position, toQuaternion(orientation)}, duration);
          },
          py::arg("particle"), py::arg("position"), py::arg("orientation"), py::arg("duration"),
          "Sets the constant velocity with which a held particle is at a pose after a duration [s], such as that of "
          "the\n"
          "next step.")
      .def(
          "set_state",
          [](Body& body, const Array& points, const py::object& velocities) {
            const Shape shape = {body.pointCount(), 3};
            Array rates(shape);
            std::fill_n(rates.mutable_data(), rates.size(), 0.0);
            if (!velocities.is_none()) {
              rates = velocities.cast<Array>();
            }
            for (const Array* array : {&points, static_cast<const Array*>(&rates)}) {
              if (Shape(array->shape(), array->shape() + array->ndim()) != shape) {
                throw py::value_error("points and velocities must have the shape " +
                                      std::string(py::str(py::cast(shape))));
              }
            }
            body.setState(points.data(), rates.data());
          },
          py::arg("points"), py::arg("velocities") = py::none(),
          "Puts the object and its copies into a state: points (P, 3) [m] as measured, velocities (P, 3) [m/s] (rest "
          "if\n"
          "not given). Holds stay where they are. Rods close the gaps that measured lengths leave; clamped at both "
          "ends,\n"
          "they have the twist that their holds give them. Raises ValueError.")
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
  module.def("make_body", &makeBodyOf, py::arg("object"), py::arg("simulation"),
             "The object that the sections `object` and `simulation` of a resolved scenario (dicts) describe. Raises\n"
             "ParameterError.");
  std::vector<std::string> kinds;
  for (const auto& maker : bodyMakers()) {
    kinds.push_back(maker.first);
  }
  module.attr("OBJECT_KINDS") = kinds;
}

}  // namespace pbd
}  // namespace deformable_manipulation
