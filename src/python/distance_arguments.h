#pragma once

// Arguments of the distances' classes from Python.

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <vector>

#include "deformable_manipulation/pbd/types.h"
#include "triangle_array.h"

using Points = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;
using Numbers3 = std::array<double, 3>;
using deformable_manipulation::pbd::Quaternion;
using deformable_manipulation::pbd::Twist;
using deformable_manipulation::pbd::Vector3;

//! From x, y, z, w.
inline Quaternion toQuaternion(const std::array<double, 4>& xyzw) {
  return Quaternion(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
}

inline Vector3 toVector(const Numbers3& xyz) { return {xyz[0], xyz[1], xyz[2]}; }
