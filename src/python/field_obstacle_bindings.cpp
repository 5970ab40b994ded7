// Obstacles of signed distances on a grid for Python.

#include <memory>
#include <utility>
#include <vector>

#include "deformable_manipulation/distance/field_obstacle.h"
#include "distance_arguments.h"

namespace py = pybind11;
using namespace deformable_manipulation::distance;

void bindFieldObstacle(py::module_& module) {
  py::class_<FieldObstacle, Obstacle, std::shared_ptr<FieldObstacle>>(
      module, "FieldObstacle",
      "Signed distances (X, Y, Z) [m] at origin (3,) + spacing (3,) * (i, j, k), interpolated trilinearly.\n\n"
      "is_free_outside: whether all that is outside of the grid is free space, and else an obstacle. Raises "
      "ValueError\n"
      "with all mistakes at once.")
      .def(py::init([](const py::array_t<float, py::array::c_style | py::array::forcecast>& values,
                       const Numbers3& origin, const Numbers3& spacing, bool is_free_outside) {
             if (values.ndim() != 3) {
               throw py::value_error("values must have the shape (X, Y, Z)");
             }
             const std::array<int, 3> size = {static_cast<int>(values.shape(0)), static_cast<int>(values.shape(1)),
                                              static_cast<int>(values.shape(2))};
             std::vector<float> copied(values.data(), values.data() + values.size());
             const py::gil_scoped_release others_go_on;
             return std::make_shared<FieldObstacle>(std::move(copied), size, toVector(origin), toVector(spacing),
                                                    is_free_outside);
           }),
           py::arg("values"), py::arg("origin"), py::arg("spacing"), py::arg("is_free_outside"))
      .def("another", &FieldObstacle::another, "The same field at the same place, for another thread.");
}
