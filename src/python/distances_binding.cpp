#include "distances_binding.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

namespace py = pybind11;
using deformable_manipulation::distance::Distances;
using deformable_manipulation::distance::Feature;
using deformable_manipulation::pbd::Vector3;
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Indices = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;
using Shape = std::vector<py::ssize_t>;
using Names = std::vector<std::string>;

namespace {

//! One row of three per feature.
template <typename Number, typename Read>
py::array_t<Number> rows(const Distances& distances, Read read) {
  py::array_t<Number> array({static_cast<py::ssize_t>(distances.features.size()), py::ssize_t{3}});
  Number* to = array.mutable_data();
  for (const Feature& feature : distances.features) {
    to = std::copy_n(read(feature), 3, to);
  }
  return array;
}

//! One number per feature.
template <typename Number>
auto column(Number Feature::*member) {
  return [member](const NamedDistances& d) {
    py::array_t<Number> array(static_cast<py::ssize_t>(d.distances.features.size()));
    Number* to = array.mutable_data();
    for (const Feature& feature : d.distances.features) {
      *to++ = feature.*member;
    }
    return array;
  };
}

auto vectors(Vector3 Feature::*member) {
  return [member](const NamedDistances& d) {
    return rows<double>(d.distances, [member](const Feature& feature) { return (feature.*member).data(); });
  };
}

template <typename Number>
py::array_t<Number> toArray(const std::vector<Number>& numbers) {
  return py::array_t<Number>(static_cast<py::ssize_t>(numbers.size()), numbers.data());
}

//! An array of numbers of a shape. Raises ValueError.
template <typename Array>
Array checked(const py::array& given, const char* name, const Shape& shape, const char* kinds) {
  if (std::string(kinds).find(given.dtype().kind()) == std::string::npos) {
    throw py::value_error(std::string(name) + " is an array of " + std::string(py::str(given.dtype())));
  }
  if (Shape(given.shape(), given.shape() + given.ndim()) != shape) {
    throw py::value_error(
        std::string(name) + " has shape " +
        std::string(py::str(py::tuple(py::cast(Shape(given.shape(), given.shape() + given.ndim()))))) + ", expected " +
        std::string(py::str(py::tuple(py::cast(shape)))));
  }
  return Array::ensure(given);
}

Numbers numbers(const py::array& given, const char* name, const Shape& shape) {
  return checked<Numbers>(given, name, shape, "fiu");
}

Indices indices(const py::array& given, const char* name, const Shape& shape) {
  return checked<Indices>(given, name, shape, "iu");
}

//! What no int holds becomes the nearest that one does, which is no index either.
int toIndex(std::int64_t value) {
  using Limits = std::numeric_limits<int>;
  return static_cast<int>(std::clamp<std::int64_t>(value, Limits::min(), Limits::max()));
}

NamedDistances make(const py::array& minimum, const py::array& offsets, const py::array& distance,
                    const py::array& obstacle, const py::array& object_point, const py::array& obstacle_point,
                    const py::array& normal, const py::array& vertices, const py::array& weights,
                    const py::array& obstacle_velocity, const py::object& identity, Names names) {
  const Shape each = {distance.size()};
  const Shape three = {distance.size(), 3};
  const Numbers minima = numbers(minimum, "minimum", {minimum.size()});
  const Indices ends = indices(offsets, "offsets", {minimum.size() + 1});
  const Numbers distance_of = numbers(distance, "distance", each);
  const Indices obstacle_of = indices(obstacle, "obstacle", each);
  const Numbers object_point_of = numbers(object_point, "object_point", three);
  const Numbers obstacle_point_of = numbers(obstacle_point, "obstacle_point", three);
  const Numbers normal_of = numbers(normal, "normal", three);
  const Indices vertices_of = indices(vertices, "vertices", three);
  const Numbers weights_of = numbers(weights, "weights", three);
  const Numbers velocity_of = numbers(obstacle_velocity, "obstacle_velocity", three);
  Indices identity_of;
  if (!identity.is_none()) {
    identity_of = indices(identity.cast<py::array>(), "identity", each);
  }
  NamedDistances result{{}, std::make_shared<const Names>(std::move(names))};
  result.distances.minimum.assign(minima.data(), minima.data() + minima.size());
  std::transform(ends.data(), ends.data() + ends.size(), std::back_inserter(result.distances.offsets), toIndex);
  for (py::ssize_t m = 0; m < distance.size(); ++m) {
    Feature feature;
    feature.distance = distance_of.at(m);
    feature.obstacle = toIndex(obstacle_of.at(m));
    feature.object_point = Eigen::Map<const Vector3>(object_point_of.data(m, 0));
    feature.obstacle_point = Eigen::Map<const Vector3>(obstacle_point_of.data(m, 0));
    feature.normal = Eigen::Map<const Vector3>(normal_of.data(m, 0));
    feature.obstacle_velocity = Eigen::Map<const Vector3>(velocity_of.data(m, 0));
    std::transform(vertices_of.data(m, 0), vertices_of.data(m, 0) + 3, feature.vertices.begin(), toIndex);
    std::copy_n(weights_of.data(m, 0), 3, feature.weights.begin());
    feature.identity = identity.is_none() ? -1 : identity_of.at(m);
    result.distances.features.push_back(feature);
  }
  return result;
}

NamedDistances unknown(int copies, Names names) {
  NamedDistances result{{}, std::make_shared<const Names>(std::move(names))};
  result.distances.minimum.assign(static_cast<std::size_t>(copies), std::numeric_limits<double>::quiet_NaN());
  result.distances.offsets.assign(static_cast<std::size_t>(copies) + 1, 0);
  return result;
}

py::slice rowsOfCopy(const NamedDistances& d, int copy) {
  const std::vector<int>& offsets = d.distances.offsets;
  if (copy < 0 || copy + 1 >= static_cast<int>(offsets.size())) {
    throw py::index_error("there are copies 0 to " + std::to_string(static_cast<int>(offsets.size()) - 2));
  }
  return py::slice(py::int_(offsets[copy]), py::int_(offsets[copy + 1]), py::none());
}

}  // namespace

void bindDistances(py::module_& module) {
  py::class_<NamedDistances>(
      module, "Distances",
      "Signed distances between C copies of an object and the obstacles.\n\n"
      "The M features of copy c are rows offsets[c] to offsets[c + 1] - 1, the nearest first. A copy has none where\n"
      "there is no obstacle; its minimum is then infinite.\n\n"
      "A feature's object point is a material point of the object, a convex combination of its geometry points:\n"
      "sum_k weights[m, k] * points[copy, vertices[m, k]]. The same vertices and weights applied to another copy\n"
      "tell where that point of the object is there.\n\n"
      "Each attribute makes a new array: take one that is needed several times into a variable.")
      .def(py::init(&make), py::kw_only(), py::arg("minimum"), py::arg("offsets"), py::arg("distance"),
           py::arg("obstacle"), py::arg("object_point"), py::arg("obstacle_point"), py::arg("normal"),
           py::arg("vertices"), py::arg("weights"), py::arg("obstacle_velocity"), py::arg("identity") = py::none(),
           py::arg("names") = Names(), "From arrays. Raises ValueError: an array has another shape or type.")
      .def_static("unknown", &unknown, py::arg("copies"), py::arg("names"),
                  "No features, and minima that are not numbers, where distances cannot be computed.")
      .def_property_readonly(
          "minimum", [](const NamedDistances& d) { return toArray(d.distances.minimum); },
          "(C,) m, from the object's surface to the obstacle's; negative: depth.")
      .def_property_readonly(
          "offsets", [](const NamedDistances& d) { return toArray(d.distances.offsets); }, "(C + 1,) int.")
      .def_property_readonly("distance", column(&Feature::distance), "(M,) m, signed.")
      .def_property_readonly("obstacle", column(&Feature::obstacle), "(M,) int, index of the obstacle.")
      .def_property_readonly("object_point", vectors(&Feature::object_point),
                             "(M, 3) m, on the centre line or mid-surface.")
      .def_property_readonly("obstacle_point", vectors(&Feature::obstacle_point), "(M, 3) m.")
      .def_property_readonly("normal", vectors(&Feature::normal),
                             "(M, 3) unit vector along which the distance grows fastest.")
      .def_property_readonly(
          "vertices",
          [](const NamedDistances& d) {
            return rows<int>(d.distances, [](const Feature& feature) { return feature.vertices.data(); });
          },
          "(M, 3) int, geometry points; unused ones have weight 0.")
      .def_property_readonly(
          "weights",
          [](const NamedDistances& d) {
            return rows<double>(d.distances, [](const Feature& feature) { return feature.weights.data(); });
          },
          "(M, 3) non-negative, sum 1.")
      .def_property_readonly("obstacle_velocity", vectors(&Feature::obstacle_velocity),
                             "(M, 3) m/s, of the obstacle at its point.")
      .def_property_readonly("identity", column(&Feature::identity),
                             "(M,) int, the same feature has the same number from call to call; -1: none.")
      .def_property_readonly(
          "names", [](const NamedDistances& d) { return py::tuple(py::cast(*d.names)); }, "Names of the obstacles.")
      .def("of_copy", &rowsOfCopy, py::arg("copy"), "Rows (slice) of the features of one copy.");
}
