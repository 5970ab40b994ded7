#include "triangle_array.h"

#include <cstdint>
#include <string>

namespace py = pybind11;

std::vector<std::array<int, 3>> toTriangles(const py::object& object, py::ssize_t count, const char* one,
                                            const char* many) {
  const py::array given = py::array::ensure(object);
  const char kind = given ? given.dtype().kind() : '?';
  if ((kind != 'i' && kind != 'u') || given.ndim() != 2 || given.shape(0) < 1 || given.shape(1) != 3) {
    throw py::value_error("triangles must be whole numbers of the shape (triangles >= 1, 3)");
  }
  const py::array_t<std::int64_t, py::array::c_style | py::array::forcecast> wide(given);
  std::vector<std::array<int, 3>> triangles(static_cast<std::size_t>(wide.shape(0)));
  const std::int64_t* index = wide.data();
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k, ++index) {
      if (*index < 0 || *index >= count) {
        throw py::value_error("triangle " + std::to_string(t) + " refers to " + one + " " + std::to_string(*index) +
                              "; there are " + many + " 0 to " + std::to_string(count - 1));
      }
      triangles[t][k] = static_cast<int>(*index);
    }
  }
  return triangles;
}
