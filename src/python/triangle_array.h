#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <array>
#include <vector>

//! Indices of the corners of triangles, refused where they are none: a cast would wrap or cut them.
//! @param count of what they refer to, whose name is `one` or `many`
std::vector<std::array<int, 3>> toTriangles(const pybind11::object& given, pybind11::ssize_t count, const char* one,
                                            const char* many);
