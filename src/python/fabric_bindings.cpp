#include <memory>

#include "bindings.h"
#include "deformable_manipulation/pbd/fabric.h"
#include "triangle_array.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

using Points = py::array_t<double, py::array::c_style | py::array::forcecast>;

std::vector<Vector3> toVertices(const Points& given) {
  if (given.ndim() != 2 || given.shape(1) != 3) {
    throw py::value_error("vertices must have the shape (vertices, 3)");
  }
  std::vector<Vector3> vertices;
  for (py::ssize_t i = 0; i < given.shape(0); ++i) {
    vertices.emplace_back(given.at(i, 0), given.at(i, 1), given.at(i, 2));
  }
  return vertices;
}

std::unique_ptr<Fabric> makeFabric(const Points& vertices, const py::object& triangles, double density,
                                   double thickness, double stretching_compliance, double bending_compliance,
                                   double damping, int threads, const Vector3& gravity, const Vector3& position,
                                   const Vector4& orientation) {
  FabricParameters p;
  p.vertices = toVertices(vertices);
  p.triangles = toTriangles(triangles, vertices.shape(0), "vertex", "vertices");
  p.density = density;
  p.thickness = thickness;
  p.stretching_compliance = stretching_compliance;
  p.bending_compliance = bending_compliance;
  p.damping = damping;
  p.threads = threads;
  p.gravity = gravity;
  p.pose = {position, toQuaternion(orientation)};
  return std::make_unique<Fabric>(p);
}

}  // namespace

void bindFabric(py::module_& module) {
  py::class_<Fabric, Body>(
      module, "Fabric",
      "A fabric: springs along the edges of a triangle mesh and bending across them (Bergou et al. 2006) with small\n"
      "substeps. Particles and points are the vertices; particles have no orientation.\n\n"
      "vertices (P, 3) [m] unstretched, triangles (T, 3) of one connected surface, density [kg/m^2], thickness [m]\n"
      "(for distances), stretching_compliance 1 / (E t) [m/N], 0 for an inextensible fabric, bending_compliance\n"
      "1 / flexural rigidity [1/(N m)], infinity for none, damping [1/s] of motion relative to the held points,\n"
      "gravity (3,) [m/s^2]; threads that advance the copies, eight each. Undeformed, vertex v lies at position (3,)\n"
      "[m] + orientation (4,) * v. Raises ParameterError; ValueError where shape or type of an array is wrong.")
      .def(py::init(&makeFabric), py::kw_only(), py::arg("vertices"), py::arg("triangles"), py::arg("density"),
           py::arg("thickness"), py::arg("stretching_compliance"), py::arg("bending_compliance"), py::arg("damping"),
           py::arg("threads") = 1, py::arg("gravity"), py::arg("position") = Vector3::Zero().eval(),
           py::arg("orientation") = Vector4(0.0, 0.0, 0.0, 1.0))
      .def("effective_compliance", &Fabric::effectiveCompliance, py::arg("substep"),
           "The stretching compliance [m/N] that it comes to with substeps of this length [s]: that of the material, "
           "or\n"
           "more where its springs are too stiff for the mesh, its mass and the substep.")
      .def("substeps_for_stiffness", &Fabric::substepsForStiffness, py::arg("time_step"), py::arg("least"),
           py::arg("most"),
           "The least number of substeps of a time step [s], from least to most, with which it has the stiffness of "
           "its\n"
           "material; most where none is enough.");
}

}  // namespace pbd
}  // namespace deformable_manipulation
