// Planar obstacles for Python.

#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "deformable_manipulation/distance/planar_obstacle.h"

namespace py = pybind11;
using namespace deformable_manipulation::distance;
using deformable_manipulation::pbd::Quaternion;
using deformable_manipulation::pbd::Twist;

namespace {

//! From x, y, z, w.
Quaternion toQuaternion(const std::array<double, 4>& xyzw) { return Quaternion(xyzw[3], xyzw[0], xyzw[1], xyzw[2]); }

}  // namespace

void bindPlanarObstacle(py::module_& module) {
  const std::array<double, 4> identity = {0.0, 0.0, 0.0, 1.0};
  py::class_<PlanarObstacle, Obstacle, std::shared_ptr<PlanarObstacle>>(
      module, "PlanarObstacle",
      "A polygon in a plane, endless along the plane's normal.\n\n"
      "Args: points (K, 2) [m], corners of a simple polygon of either orientation, on the two of the obstacle's axes\n"
      "that plane names ('xy', 'yz' or 'xz'); translation (3,) [m] and rotation (4,), quaternion x, y, z, w, of the\n"
      "obstacle in the fixed frame. Raises ValueError with all mistakes at once.")
      .def(py::init([](const std::vector<std::array<double, 2>>& points, const std::string& plane,
                       const Vector3& translation, const std::array<double, 4>& rotation) {
             return std::make_shared<PlanarObstacle>(points, plane, translation, toQuaternion(rotation));
           }),
           py::arg("points"), py::arg("plane") = "yz", py::arg("translation") = Vector3::Zero().eval(),
           py::arg("rotation") = identity)
      .def(
          "set_pose",
          [](PlanarObstacle& obstacle, const Vector3& translation, const std::array<double, 4>& rotation,
             const Vector3& linear, const Vector3& angular) {
            obstacle.setPose(translation, toQuaternion(rotation), Twist{linear, angular});
          },
          py::arg("translation"), py::arg("rotation"), py::arg("linear_velocity") = Vector3::Zero().eval(),
          py::arg("angular_velocity") = Vector3::Zero().eval(),
          "Moves the obstacle. The velocities [m/s, rad/s] are those of its origin and about it, in the fixed frame.\n"
          "Raises ValueError with all mistakes at once.");
}
