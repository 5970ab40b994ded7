// Minimum distances for Python: deformable_manipulation._distance

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <string>
#include <vector>

#include "deformable_manipulation/distance/minimum_distance.h"
#include "distance_arguments.h"
#include "distances_binding.h"

namespace py = pybind11;
using namespace deformable_manipulation::distance;

void bindPlanarObstacle(py::module_& module);
void bindMeshObstacle(py::module_& module);
void bindPrimitiveObstacle(py::module_& module);
void bindCloudObstacle(py::module_& module);
void bindFieldObstacle(py::module_& module);
void bindDistances(py::module_& module);

namespace {

//! The object that arguments from Python describe; valid as long as they are.
class GivenObject {
 public:
  GivenObject(const Points& points, const py::object& triangles) {
    if (points.ndim() != 3 || points.shape(2) != 3) {
      throw py::value_error("points must have the shape (copies, points, 3)");
    }
    view.points = points.data();
    view.copies = static_cast<int>(points.shape(0));
    view.point_count = static_cast<int>(points.shape(1));
    if (!triangles.is_none()) {
      faces_ = toTriangles(triangles, points.shape(1), "point", "points");
      view.triangles = faces_.data();
      view.triangle_count = static_cast<int>(faces_.size());
    }
  }

  ObjectView view;

 private:
  std::vector<std::array<int, 3>> faces_;
};

NamedDistances compute(NamedMinimumDistance& distance, const Points& points, const py::object& triangles) {
  return {distance.native.compute(GivenObject(points, triangles).view), distance.names};
}

void warm(const std::shared_ptr<Obstacle>& obstacle, const Points& points, const py::object& triangles) {
  const GivenObject object(points, triangles);
  MinimumDistance distance({obstacle}, 0.0, 0.0);
  const py::gil_scoped_release others_go_on;
  distance.compute(object.view);
}

void bindObstacle(py::module_& module) {
  py::class_<Obstacle, std::shared_ptr<Obstacle>>(module, "Obstacle", "Something to keep off.")
      .def(
          "set_pose",
          [](Obstacle& moved, const Numbers3& translation, const std::array<double, 4>& rotation,
             const Numbers3& linear, const Numbers3& angular) {
            moved.setPose(toVector(translation), toQuaternion(rotation), Twist{toVector(linear), toVector(angular)});
          },
          py::arg("translation"), py::arg("rotation"), py::arg("linear_velocity") = Numbers3{},
          py::arg("angular_velocity") = Numbers3{},
          "Moves the obstacle. The velocities [m/s, rad/s] are those of its origin and about it, in the fixed frame.\n"
          "Raises ValueError with all mistakes at once.")
      .def("warm", &warm, py::arg("points"), py::arg("triangles") = py::none(),
           "Find what is near copies (C, P, 3) [m] of an object, so that the next computation for about the same ones\n"
           "is as fast as any. Other threads of Python go on.");
}

void requireObstacles(const std::vector<std::shared_ptr<Obstacle>>& obstacles) {
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    if (obstacles[i] == nullptr) {
      throw py::value_error("obstacles[" + std::to_string(i) + "] is None; it must be an Obstacle");
    }
  }
}

}  // namespace

PYBIND11_MODULE(_distance, module) {
  module.doc() = "Signed minimum distances between a deformable object's copies and obstacles (C++ core).";
  bindObstacle(module);
  bindPlanarObstacle(module);
  bindMeshObstacle(module);
  bindPrimitiveObstacle(module);
  bindCloudObstacle(module);
  bindFieldObstacle(module);
  bindDistances(module);
  py::class_<NamedMinimumDistance, std::shared_ptr<NamedMinimumDistance>>(
      module, "MinimumDistance",
      "Signed minimum distances between all copies of an object and several obstacles, from surface to surface.\n\n"
      "Raises ValueError: margin or band [m] is negative or not finite.")
      .def(py::init([](std::vector<std::shared_ptr<Obstacle>> obstacles, double margin, double band,
                       std::vector<std::string> names) {
             requireObstacles(obstacles);
             return std::make_shared<NamedMinimumDistance>(
                 NamedMinimumDistance{MinimumDistance(std::move(obstacles), margin, band),
                                      std::make_shared<const std::vector<std::string>>(std::move(names))});
           }),
           py::arg("obstacles"), py::arg("margin"), py::arg("band"), py::arg("names") = std::vector<std::string>())
      .def(
          "replace",
          [](NamedMinimumDistance& distance, std::size_t index, const std::shared_ptr<Obstacle>& obstacle) {
            distance.native.replace(index, obstacle);
          },
          py::arg("index"), py::arg("obstacle"),
          "Another Obstacle in the place of one. Raises ValueError: there is no such place.")
      .def("compute", &compute, py::arg("points"), py::arg("triangles") = py::none(),
           "Distances of points (C, P, 3) [m] with triangles (T, 3), or None for a polyline. Raises ValueError for "
           "another shape or numbers that are not finite.");
}
