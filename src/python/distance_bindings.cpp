// Minimum distances for Python: deformable_manipulation._distance

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "deformable_manipulation/distance/minimum_distance.h"
#include "distance_arguments.h"

namespace py = pybind11;
using namespace deformable_manipulation::distance;

void bindPlanarObstacle(py::module_& module);
void bindMeshObstacle(py::module_& module);

namespace {

Selection toSelection(const std::string& name) {
  if (name == "local") {
    return Selection::LOCAL;
  }
  if (name == "elements") {
    return Selection::ELEMENTS;
  }
  throw py::value_error("features is '" + name + "'; allowed are 'local' and 'elements'");
}

//! One row per feature.
template <typename Number, typename Read>
py::array_t<Number> rows(const Distances& distances, Read read) {
  py::array_t<Number> array({static_cast<py::ssize_t>(distances.features.size()), py::ssize_t{3}});
  Number* to = array.mutable_data();
  for (const Feature& feature : distances.features) {
    to = std::copy_n(read(feature), 3, to);
  }
  return array;
}

//! One number per feature.
template <typename Number>
py::array_t<Number> column(const Distances& distances, Number Feature::*member) {
  py::array_t<Number> array(static_cast<py::ssize_t>(distances.features.size()));
  Number* to = array.mutable_data();
  for (const Feature& feature : distances.features) {
    *to++ = feature.*member;
  }
  return array;
}

py::array_t<double> vectors(const Distances& distances, Vector3 Feature::*member) {
  return rows<double>(distances, [member](const Feature& f) { return (f.*member).data(); });
}

py::tuple toTuple(const Distances& d) {
  return py::make_tuple(py::array_t<double>(static_cast<py::ssize_t>(d.minimum.size()), d.minimum.data()),
                        py::array_t<int>(static_cast<py::ssize_t>(d.offsets.size()), d.offsets.data()),
                        column(d, &Feature::distance), column(d, &Feature::obstacle),
                        vectors(d, &Feature::object_point), vectors(d, &Feature::obstacle_point),
                        vectors(d, &Feature::normal), rows<int>(d, [](const Feature& f) { return f.vertices.data(); }),
                        rows<double>(d, [](const Feature& f) { return f.weights.data(); }),
                        vectors(d, &Feature::obstacle_velocity), column(d, &Feature::identity));
}

void requireObstacles(const std::vector<std::shared_ptr<Obstacle>>& obstacles) {
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    if (obstacles[i] == nullptr) {
      throw py::value_error("obstacles[" + std::to_string(i) + "] is None; it must be an Obstacle");
    }
  }
}

py::tuple compute(MinimumDistance& distance, const Points& points, const py::object& triangles) {
  if (points.ndim() != 3 || points.shape(2) != 3) {
    throw py::value_error("points must have the shape (copies, points, 3)");
  }
  ObjectView object;
  object.points = points.data();
  object.copies = static_cast<int>(points.shape(0));
  object.point_count = static_cast<int>(points.shape(1));
  std::vector<std::array<int, 3>> faces;
  if (!triangles.is_none()) {
    faces = toTriangles(triangles, points.shape(1), "point", "points");
    object.triangles = faces.data();
    object.triangle_count = static_cast<int>(faces.size());
  }
  return toTuple(distance.compute(object));
}

}  // namespace

PYBIND11_MODULE(_distance, module) {
  module.doc() = "Signed minimum distances between a deformable object's copies and obstacles (C++ core).";
  py::class_<Obstacle, std::shared_ptr<Obstacle>>(module, "Obstacle", "Something to keep off.");
  bindPlanarObstacle(module);
  bindMeshObstacle(module);
  py::class_<MinimumDistance>(
      module, "MinimumDistance",
      "Signed minimum distances between all copies of an object and several obstacles, from surface to surface.\n\n"
      "Raises ValueError: margin or band [m] is negative or not finite, or features is neither 'local' nor\n"
      "'elements'.")
      .def(py::init([](std::vector<std::shared_ptr<Obstacle>> obstacles, double margin, double band,
                       const std::string& features) {
             requireObstacles(obstacles);
             return std::make_unique<MinimumDistance>(std::move(obstacles), margin, band, toSelection(features));
           }),
           py::arg("obstacles"), py::arg("margin"), py::arg("band") = 0.1, py::arg("features") = "elements")
      .def("compute", &compute, py::arg("points"), py::arg("triangles") = py::none(),
           "The fields of distance.features.Distances but for the names, for points (C, P, 3) [m] and triangles\n"
           "(T, 3), or None for a polyline. Raises ValueError for another shape or numbers that are not finite.");
}
