// Obstacles of triangles for Python.

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "deformable_manipulation/distance/mesh_obstacle.h"
#include "distance_arguments.h"

namespace py = pybind11;
using namespace deformable_manipulation::distance;

namespace {

std::vector<Vector3> toVertices(const Points& given) {
  if (given.ndim() != 2 || given.shape(1) != 3) {
    throw py::value_error("vertices must have the shape (vertices, 3)");
  }
  std::vector<Vector3> vertices(static_cast<std::size_t>(given.shape(0)));
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    vertices[i] = Eigen::Map<const Vector3>(given.data() + 3 * i);
  }
  return vertices;
}

}  // namespace

void bindMeshObstacle(py::module_& module) {
  const std::array<double, 4> identity = {0.0, 0.0, 0.0, 1.0};
  py::class_<MeshObstacle, Obstacle, std::shared_ptr<MeshObstacle>> mesh(
      module, "MeshObstacle",
      "The surface of triangles: solids where it is closed, elsewhere sheets without a sign.\n\n"
      "Args: vertices (V, 3) [m] of its own frame; triangles (T, 3), indices of vertices, wound either way;\n"
      "translation (3,) [m] and rotation (4,), quaternion x, y, z, w, of the obstacle in the fixed frame. Raises\n"
      "ValueError with all mistakes at once.");
  mesh.def(py::init([](const Points& vertices, const py::object& triangles, const Numbers3& translation,
                       const std::array<double, 4>& rotation) {
             const std::vector<Vector3> corners = toVertices(vertices);
             const auto faces = toTriangles(triangles, static_cast<py::ssize_t>(corners.size()), "vertex", "vertices");
             return std::make_shared<MeshObstacle>(corners, faces, toVector(translation), toQuaternion(rotation));
           }),
           py::arg("vertices"), py::arg("triangles"), py::arg("translation") = Numbers3{},
           py::arg("rotation") = identity);
  mesh.def_static(
      "of_cells",
      [](const py::array& given, double size, bool endless) {
        const bool whole = given.dtype().kind() == 'i' || given.dtype().kind() == 'u';
        if (!whole || given.ndim() != 2 || given.shape(1) != 3) {
          throw py::value_error("cells must be whole numbers of the shape (cells, 3)");
        }
        const py::array_t<int, py::array::c_style | py::array::forcecast> cells(given);
        std::vector<std::array<int, 3>> cubes(static_cast<std::size_t>(cells.shape(0)));
        for (std::size_t i = 0; i < cubes.size(); ++i) {
          std::copy_n(cells.data() + 3 * i, 3, cubes[i].begin());
        }
        const py::gil_scoped_release others_go_on;
        return MeshObstacle::ofCells(cubes, size, endless);
      },
      py::arg("cells"), py::arg("size"), py::arg("endless") = false,
      "Cubes as one solid: cells (N, 3) int32, of which (i, j, k) has the corners size * (i, j, k) and\n"
      "size * (i + 1, j + 1, k + 1) [m]; endless: they are free, and all else is solid.");
  mesh.def("another", &MeshObstacle::another, "The same shape at the same place, for another thread.");
  mesh.def_property_readonly("warnings", &MeshObstacle::warnings,
                             "Sentences about what was dropped or turned, and what has no sign.");
}
