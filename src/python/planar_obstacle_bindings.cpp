// Planar obstacles for Python.

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "deformable_manipulation/distance/planar_obstacle.h"
#include "distance_arguments.h"

namespace py = pybind11;
using namespace deformable_manipulation::distance;

namespace {

using PlanarObstacleClass = py::class_<PlanarObstacle, Obstacle, std::shared_ptr<PlanarObstacle>>;

//! @tparam Shape one ring, or several
template <typename Shape>
void bindConstructor(const char* shape_name, PlanarObstacleClass* polygon) {
  const std::array<double, 4> identity = {0.0, 0.0, 0.0, 1.0};
  polygon->def(py::init([](const Shape& shape, const std::string& plane, const Numbers3& translation,
                           const std::array<double, 4>& rotation) {
                 return std::make_shared<PlanarObstacle>(shape, plane, toVector(translation), toQuaternion(rotation));
               }),
               py::arg(shape_name), py::arg("plane") = "yz", py::arg("translation") = Numbers3{},
               py::arg("rotation") = identity);
}

}  // namespace

void bindPlanarObstacle(py::module_& module) {
  PlanarObstacleClass polygon(
      module, "PlanarObstacle",
      "A polygon in a plane, endless along the plane's normal.\n\n"
      "Args: points (K, 2) [m], corners of a simple polygon of either orientation, or rings, a list of such: what an "
      "odd\n"
      "number of them enclose is inside. They are on the two of the obstacle's axes that plane names ('xy', 'yz' or\n"
      "'xz'). translation (3,) [m] and rotation (4,), quaternion x, y, z, w: of the obstacle in the fixed frame.\n"
      "Raises ValueError with all mistakes at once.");
  bindConstructor<std::vector<std::vector<std::array<double, 2>>>>("rings", &polygon);
  bindConstructor<std::vector<std::array<double, 2>>>("points", &polygon);
}
