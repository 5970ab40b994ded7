#pragma once

// What the bindings of the C++ core share.

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "deformable_manipulation/pbd/body.h"
#include "deformable_manipulation/pbd/errors.h"

namespace deformable_manipulation {
namespace pbd {

namespace py = pybind11;
using Array = py::array_t<double, py::array::c_style>;
using Vector4 = Eigen::Vector4d;
using Shape = std::vector<py::ssize_t>;

inline Quaternion toQuaternion(const Vector4& xyzw) { return Quaternion(xyzw[3], xyzw[0], xyzw[1], xyzw[2]); }

//! The array given to be filled, if it fits, or a new one.
Array filled(const py::object& out, const Shape& shape);

template <typename Value>
Value choose(const std::string& key, const std::string& given,
             const std::vector<std::pair<const char*, Value>>& choices) {
  std::string allowed;
  for (const auto& choice : choices) {
    if (given == choice.first) {
      return choice.second;
    }
    allowed += (allowed.empty() ? "" : " or ") + std::string(choice.first);
  }
  throw ParameterError({{key, "'" + given + "'", allowed}});
}

Hold toHold(const std::string& name);

//! Geometry points of all copies, (C, P, 3).
Array pointsOf(const Body& body, const py::object& out);

std::vector<MaterialParameter> toParameters(const std::map<std::string, double>& parameters);

inline std::pair<Vector3, Vector3> toPair(const Wrench& wrench) { return {wrench.force, wrench.torque}; }

// One function per file of bindings.
void bindErrors(py::module_& module);
void bindBody(py::module_& module);
void bindRod(py::module_& module);
void bindRestShapes(py::module_& module);
void bindEquilibrium(py::module_& module);
void bindFabric(py::module_& module);
void bindSimulation(py::module_& module);

}  // namespace pbd
}  // namespace deformable_manipulation
