#pragma once

// Arguments of the distances' classes from Python.

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <vector>

#include "deformable_manipulation/pbd/types.h"

using Points = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;
using Triangles = std::vector<std::array<int, 3>>;
using deformable_manipulation::pbd::Quaternion;
using deformable_manipulation::pbd::Twist;
using deformable_manipulation::pbd::Vector3;

//! Indices, refused where they are none: a cast would wrap or cut them.
//! @param count of what they refer to, whose name is `one` or `many`
Triangles toTriangles(const pybind11::object& given, pybind11::ssize_t count, const char* one, const char* many);

//! From x, y, z, w.
inline Quaternion toQuaternion(const std::array<double, 4>& xyzw) {
  return Quaternion(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
}

//! The method that moves an obstacle.
template <typename Class>
void bindPose(Class* obstacle) {
  namespace py = pybind11;
  using Type = typename Class::type;
  obstacle->def(
      "set_pose",
      [](Type& moved, const Vector3& translation, const std::array<double, 4>& rotation, const Vector3& linear,
         const Vector3& angular) {
        moved.setPose(translation, toQuaternion(rotation), Twist{linear, angular});
      },
      py::arg("translation"), py::arg("rotation"), py::arg("linear_velocity") = Vector3::Zero().eval(),
      py::arg("angular_velocity") = Vector3::Zero().eval(),
      "Moves the obstacle. The velocities [m/s, rad/s] are those of its origin and about it, in the fixed frame.\n"
      "Raises ValueError with all mistakes at once.");
}
