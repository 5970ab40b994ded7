// Planar obstacles for Python.

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "deformable_manipulation/distance/planar_obstacle.h"
#include "distance_arguments.h"

namespace py = pybind11;
using namespace deformable_manipulation::distance;

void bindPlanarObstacle(py::module_& module) {
  const std::array<double, 4> identity = {0.0, 0.0, 0.0, 1.0};
  py::class_<PlanarObstacle, Obstacle, std::shared_ptr<PlanarObstacle>> polygon(
      module, "PlanarObstacle",
      "A polygon in a plane, endless along the plane's normal.\n\n"
      "Args: points (K, 2) [m], corners of a simple polygon of either orientation, on the two of the obstacle's axes\n"
      "that plane names ('xy', 'yz' or 'xz'); translation (3,) [m] and rotation (4,), quaternion x, y, z, w, of the\n"
      "obstacle in the fixed frame. Raises ValueError with all mistakes at once.");
  polygon.def(py::init([](const std::vector<std::array<double, 2>>& points, const std::string& plane,
                          const Numbers3& translation, const std::array<double, 4>& rotation) {
                return std::make_shared<PlanarObstacle>(points, plane, toVector(translation), toQuaternion(rotation));
              }),
              py::arg("points"), py::arg("plane") = "yz", py::arg("translation") = Numbers3{},
              py::arg("rotation") = identity);
  bindPose(&polygon);
}
