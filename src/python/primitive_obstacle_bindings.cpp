// Obstacles that are given by numbers for Python.

#include <memory>

#include "deformable_manipulation/distance/primitive_obstacle.h"
#include "distance_arguments.h"

namespace py = pybind11;
using namespace deformable_manipulation::distance;

void bindPrimitiveObstacle(py::module_& module) {
  py::class_<PrimitiveObstacle, Obstacle, std::shared_ptr<PrimitiveObstacle>>(
      module, "PrimitiveObstacle",
      "A convex solid, given by numbers [m], at the origin of its own frame: set_pose puts it elsewhere.\n\n"
      "All functions raise ValueError with all mistakes at once.")
      .def_static(
          "half_space", [](const Numbers3& normal) { return PrimitiveObstacle::halfSpace(toVector(normal)); },
          py::arg("normal"), "All points on and behind a plane through the origin; normal (3,) points away from them.")
      .def_static("sphere", &PrimitiveObstacle::sphere, py::arg("radius"))
      .def_static(
          "box", [](const Numbers3& size) { return PrimitiveObstacle::box(toVector(size)); }, py::arg("size"),
          "With sides (3,) along its own axes.")
      .def_static("cylinder", &PrimitiveObstacle::cylinder, py::arg("radius"), py::arg("length"),
                  "Around its own z axis.")
      .def_static("capsule", &PrimitiveObstacle::capsule, py::arg("radius"), py::arg("length"),
                  "All points within the radius from a piece of that length of its own z axis.");
}
