#include "parameter_value_from_python.h"

#include <pybind11/numpy.h>

#include <string>
#include <utility>

namespace py = pybind11;
using deformable_manipulation::ParameterValue;

ParameterValue toParameterValue(const py::handle& value) {
  if (value.is_none()) {
    return {};
  }
  if (py::isinstance<py::bool_>(value)) {
    return value.cast<bool>();
  }
  if (py::isinstance<py::str>(value)) {
    return value.cast<std::string>();
  }
  if (py::isinstance<py::dict>(value)) {
    ParameterValue::Mapping mapping;
    for (const auto& [key, item] : py::reinterpret_borrow<py::dict>(value)) {
      mapping.emplace(key.cast<std::string>(), toParameterValue(item));
    }
    return mapping;
  }
  if (py::isinstance<py::array>(value)) {
    return toParameterValue(value.attr("tolist")());
  }
  if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) {
    ParameterValue::List list;
    for (const py::handle item : value) {
      list.push_back(toParameterValue(item));
    }
    return list;
  }
  if (PyFloat_Check(value.ptr()) || PyLong_Check(value.ptr()) ||
      py::isinstance(value, py::module_::import("numbers").attr("Real"))) {
    return value.cast<double>();
  }
  throw py::type_error(std::string("no parameter can be of the type ") + Py_TYPE(value.ptr())->tp_name);
}
