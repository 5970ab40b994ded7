#include "observation_reader.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <cstdint>
#include <limits>

#include "distances_binding.h"

namespace py = pybind11;
using deformable_manipulation::control::findFault;
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Integers = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;
using Flags = py::array_t<bool, py::array::c_style>;

namespace {

struct Unusable {
  std::string fault;
};

std::string text(const std::vector<py::ssize_t>& shape) { return py::str(py::tuple(py::cast(shape))); }

//! An attribute that must be an array of one of the kinds of numpy's numbers.
py::array arrayOf(const py::handle& owner, const char* key, const char* name, const char* kinds) {
  const py::object value = owner.attr(key);
  if (!py::isinstance<py::array>(value)) {
    throw Unusable{std::string(name) + " of the state is " + Py_TYPE(value.ptr())->tp_name + ", expected an array"};
  }
  const py::array array = py::reinterpret_borrow<py::array>(value);
  if (std::string(kinds).find(array.dtype().kind()) == std::string::npos) {
    throw Unusable{std::string(name) + " of the state is an array of " + std::string(py::str(array.dtype()))};
  }
  return array;
}

double number(const py::handle& owner, const char* name) {
  const py::object value = owner.attr(name);
  if (!PyFloat_Check(value.ptr()) && !py::isinstance(value, py::module_::import("numbers").attr("Real"))) {
    throw Unusable{std::string(name) + " of the state is " + Py_TYPE(value.ptr())->tp_name + ", expected a number"};
  }
  return value.cast<double>();
}

void requireShape(const py::array& array, const char* name, const std::vector<py::ssize_t>& shape) {
  const auto given = static_cast<std::size_t>(array.ndim());
  if (given != shape.size() || !std::equal(shape.begin(), shape.end(), array.shape())) {
    throw Unusable{std::string(name) + " of the state has shape " +
                   text({array.shape(), array.shape() + array.ndim()}) + ", expected " + text(shape)};
  }
}

}  // namespace

std::string ObservationReader::read(const py::handle& observation, int agents) {
  arrays_.clear();
  conversions_ = 0;
  view_ = {};
  try {
    readState(observation, agents);
    readIntent(observation.attr("intent"));
    readDistances(observation.attr("distances"));
  } catch (const Unusable& unusable) {
    return unusable.fault;
  }
  return findFault(view_);
}

void ObservationReader::readState(const py::handle& observation, int agents) {
  view_.time = number(observation, "time");
  view_.lateness = number(observation, "lateness");
  view_.agents = agents;
  const py::array points = arrayOf(observation, "points", "points", "fiu");
  if (points.ndim() != 3 || points.shape(0) == 0) {
    throw Unusable{"points of the state has shape " + text({points.shape(), points.shape() + points.ndim()}) +
                   ", expected (C, P, 3)"};
  }
  view_.copies = static_cast<int>(points.shape(0));
  view_.points = static_cast<int>(points.shape(1));
  const py::ssize_t copies = view_.copies;
  view_.coordinates = numbers(observation, "points", "points", {copies, view_.points, 3});
  view_.positions = numbers(observation, "positions", "positions", {agents, 3});
  view_.displaced_agents = indices(observation, "displaced_agents", "displaced_agents", {copies});
  view_.displacements = numbers(observation, "displacements", "displacements", {copies, 3});
  const py::array ready = arrayOf(observation, "ready", "ready", "b");
  requireShape(ready, "ready", {copies});
  arrays_.push_back(Flags::ensure(ready));
  view_.ready = py::reinterpret_borrow<Flags>(arrays_.back()).data();
  if (!observation.attr("velocities").is_none()) {
    view_.velocities = numbers(observation, "velocities", "velocities", {agents, 3});
  }
  if (!observation.attr("obstacles").is_none()) {
    view_.obstacles = static_cast<int>(arrayOf(observation, "obstacles", "obstacles", "fiu").shape(0));
    view_.obstacle_poses = numbers(observation, "obstacles", "obstacles", {view_.obstacles, 7});
  }
  if (!observation.attr("correction").is_none()) {
    view_.correction = numbers(observation, "correction", "correction", {view_.points, 3});
  }
  if (!observation.attr("sensitivities").is_none()) {
    view_.sensitivities = numbers(observation, "sensitivities", "sensitivities", {agents, view_.points, 3, 3});
  }
  if (!observation.attr("turning_sensitivities").is_none()) {
    view_.turning_sensitivities =
        numbers(observation, "turning_sensitivities", "turning_sensitivities", {agents, view_.points, 3, 3});
  }
  if (!observation.attr("orientations").is_none()) {
    view_.orientations = numbers(observation, "orientations", "orientations", {agents, 4});
  }
  if (!observation.attr("angular_velocities").is_none()) {
    view_.angular_velocities = numbers(observation, "angular_velocities", "angular_velocities", {agents, 3});
  }
  if (!observation.attr("wrenches").is_none()) {
    view_.wrenches = numbers(observation, "wrenches", "wrenches", {copies, agents, 6});
  }
  if (!observation.attr("wrench_sensitivities").is_none()) {
    view_.wrench_sensitivities =
        numbers(observation, "wrench_sensitivities", "wrench_sensitivities", {agents, 6, agents, 6});
  }
}

void ObservationReader::readIntent(const py::handle& intent) {
  if (intent.is_none()) {
    return;
  }
  const py::array times = arrayOf(intent, "times", "intent.times", "fiu");
  const py::ssize_t count = times.size();
  view_.announcement.count = static_cast<int>(count);
  view_.announcement.times = numbers(intent, "times", "intent.times", {count});
  view_.announcement.positions = numbers(intent, "positions", "intent.positions", {count, 3});
}

void ObservationReader::readDistances(const py::handle& distances) {
  if (!py::isinstance<NamedDistances>(distances)) {
    throw Unusable{std::string("distances of the state is ") + Py_TYPE(distances.ptr())->tp_name +
                   ", expected Distances"};
  }
  view_.distances = &distances.cast<const NamedDistances&>().distances;
  owner_ = py::reinterpret_borrow<py::object>(distances);
}

const double* ObservationReader::numbers(const py::handle& owner, const char* key, const char* name,
                                         const Shape& shape) {
  const py::array array = arrayOf(owner, key, name, "fiu");
  requireShape(array, name, shape);
  arrays_.push_back(Numbers::ensure(array));
  return py::reinterpret_borrow<Numbers>(arrays_.back()).data();
}

//! What no int holds becomes the nearest that one does, which is no index either.
const int* ObservationReader::indices(const py::handle& owner, const char* key, const char* name, const Shape& shape) {
  const py::array array = arrayOf(owner, key, name, "iu");
  requireShape(array, name, shape);
  if (py::isinstance<py::array_t<int, py::array::c_style>>(array)) {
    arrays_.push_back(array);
    return static_cast<const int*>(array.data());
  }
  if (conversions_ == converted_.size()) {
    converted_.emplace_back();
  }
  std::vector<int>& to = converted_[conversions_++];
  const Integers wide(array);
  to.resize(static_cast<std::size_t>(wide.size()));
  std::transform(wide.data(), wide.data() + wide.size(), to.begin(), [](std::int64_t value) {
    using Limits = std::numeric_limits<int>;
    return static_cast<int>(std::clamp<std::int64_t>(value, Limits::min(), Limits::max()));
  });
  return to.data();
}
