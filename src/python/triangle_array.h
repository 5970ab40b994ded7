#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

//! Indices of points, refused where they are none: a cast would wrap or cut them.
//! @param or_else  what else may be given, for the error
inline std::vector<std::array<int, 3>> toTriangles(const pybind11::array& given, pybind11::ssize_t points,
                                                   const std::string& or_else = "") {
  namespace py = pybind11;
  const char kind = given ? given.dtype().kind() : '?';  // null where it was no array
  if ((kind != 'i' && kind != 'u') || given.ndim() != 2 || given.shape(0) < 1 || given.shape(1) != 3) {
    throw py::value_error("triangles must be whole numbers of the shape (triangles >= 1, 3)" + or_else);
  }
  const py::array_t<std::int64_t, py::array::c_style | py::array::forcecast> wide(given);
  std::vector<std::array<int, 3>> triangles(static_cast<std::size_t>(wide.shape(0)));
  for (py::ssize_t t = 0; t < wide.shape(0); ++t) {
    for (int k = 0; k < 3; ++k) {
      const std::int64_t vertex = wide.at(t, k);
      if (vertex < 0 || vertex >= points) {
        throw py::value_error("triangle " + std::to_string(t) + " refers to point " + std::to_string(vertex) +
                              "; there are points 0 to " + std::to_string(points - 1));
      }
      triangles[t][k] = static_cast<int>(vertex);
    }
  }
  return triangles;
}
