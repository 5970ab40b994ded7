#include <pybind11/eigen.h>
#include <pybind11/numpy.h>

#include <memory>
#include <string>

#include "control_bindings.h"
#include "deformable_manipulation/control/differences.h"
#include "deformable_manipulation/control/response_gradients.h"
#include "observation_reader.h"

namespace py = pybind11;
using namespace deformable_manipulation::control;

namespace {

py::array_t<double> toArray(const std::vector<Vector3>& vectors) {
  py::array_t<double> array({static_cast<py::ssize_t>(vectors.size()), py::ssize_t{3}});
  std::copy_n(vectors.empty() ? nullptr : vectors.front().data(), 3 * vectors.size(), array.mutable_data());
  return array;
}

py::array_t<double> gradientsOf(const Features& features) {
  py::array_t<double> array({features.size(), features.agents(), 3});
  double* to = array.mutable_data();
  for (int m = 0; m < features.size(); ++m) {
    for (int agent = 0; agent < features.agents(); ++agent) {
      to = std::copy_n(features.gradient(m, agent).data(), 3, to);
    }
  }
  return array;
}

Features makeFeatures(const py::array_t<double>& distance, const py::array_t<double>& normal,
                      const py::array_t<double>& velocity, const py::array_t<double>& gradients, double parting) {
  using Dense = py::array_t<double, py::array::c_style | py::array::forcecast>;
  const Dense d(distance), n(normal), v(velocity), g(gradients);
  const py::ssize_t count = d.size();
  if (n.size() != 3 * count || v.size() != 3 * count || g.ndim() != 3 || g.shape(0) != count || g.shape(2) != 3) {
    throw py::value_error("expected distance (M,), normal (M, 3), obstacle_velocity (M, 3), gradients (M, A, 3)");
  }
  deformable_manipulation::distance::Distances distances;
  distances.offsets = {0, static_cast<int>(count)};
  distances.features.resize(static_cast<std::size_t>(count));
  for (py::ssize_t m = 0; m < count; ++m) {
    distances.features[m].distance = d.at(m);
    distances.features[m].normal = Eigen::Map<const Vector3>(n.data() + 3 * m);
    distances.features[m].obstacle_velocity = Eigen::Map<const Vector3>(v.data() + 3 * m);
  }
  Features features;
  features.take({distances}, static_cast<int>(g.shape(1)));
  features.parting.assign(features.parting.size(), parting);
  for (int m = 0; m < features.size(); ++m) {
    for (int agent = 0; agent < features.agents(); ++agent) {
      features.gradient(m, agent) = Eigen::Map<const Vector3>(g.data(m, agent, 0));
    }
  }
  return features;
}

//! Differences that read observations of so many agents.
struct BoundDifferences {
  Differences differences;
  int agents;
  ObservationReader reader;

  BoundDifferences(int count, int leader) : differences(count, leader), agents(count) {}

  const ObservationView& read(const py::object& observation) {
    const std::string fault = reader.read(observation, agents);
    if (!fault.empty()) {
      throw py::value_error(fault);
    }
    return reader.view();
  }
};

}  // namespace

void bindGradients(py::module_& module) {
  py::class_<Features>(
      module, "Features",
      "M nearest features of the object: distance (M,) [m], normal (M, 3), obstacle_velocity (M, 3)\n"
      "[m/s], gradients (M, A, 3): gradients[m, a] . v is the rate at which feature m's distance grows\n"
      "when agent a's held point moves with the velocity v; parting (M,) [m] along the normal of what\n"
      "the perturbed copies say.")
      .def(py::init(&makeFeatures), py::arg("distance"), py::arg("normal"), py::arg("obstacle_velocity"),
           py::arg("gradients"), py::arg("parting") = 0.0)
      .def_property_readonly("distance",
                             [](const Features& f) { return py::array_t<double>(f.size(), f.distance.data()); })
      .def_property_readonly("normal", [](const Features& f) { return toArray(f.normal); })
      .def_property_readonly("obstacle_velocity", [](const Features& f) { return toArray(f.obstacle_velocity); })
      .def_property_readonly("gradients", &gradientsOf)
      .def_property_readonly("parting",
                             [](const Features& f) { return py::array_t<double>(f.size(), f.parting.data()); });
  py::class_<BoundDifferences>(module, "Differences",
                               "Displacement rates of the object from its perturbed copies, kept over the cycles.")
      .def(py::init<int, int>(), py::arg("agents"), py::arg("leader"))
      .def(
          "reset", [](BoundDifferences& b) { b.differences.reset(); }, "Forgets all rates.")
      .def(
          "known", [](const BoundDifferences& b, int agent) { return b.differences.known(agent); }, py::arg("agent"),
          "Whether all copies of an agent have been ready at once since the start or reset.")
      .def(
          "update", [](BoundDifferences& b, const py::object& seen) { b.differences.update(b.read(seen)); },
          py::arg("observation"), "Takes in the copies of an observation. Raises ValueError.")
      .def(
          "features",
          [](BoundDifferences& b, const py::object& seen) {
            Features features;
            b.differences.takeGradients(b.read(seen), features);
            return features;
          },
          py::arg("observation"), "All features of copy 0, each with the rates of its own material point.")
      .def(
          "minimum",
          [](BoundDifferences& b, const py::object& seen) {
            Features features;
            b.differences.takeMinimum(*b.read(seen).distances, features);
            return features;
          },
          py::arg("observation"), "The nearest feature of copy 0 with the rates of the minimum distance.");
  module.def(
      "find_fault",
      [](const py::object& observation, int agents) { return ObservationReader().read(observation, agents); },
      py::arg("observation"), py::arg("agents"),
      "What makes an observation unusable, as a clause that names the field, or an empty string.");
  module.def(
      "response_features",
      [](const py::object& observation, int agents, int leader, bool nearest_only) {
        ObservationReader reader;
        const std::string fault = reader.read(observation, agents);
        if (!fault.empty() || reader.view().sensitivities == nullptr) {
          throw py::value_error(fault.empty() ? "sensitivities of the state is None" : fault);
        }
        Features features;
        const ObservationView& view = reader.view();
        takeResponseGradients(nearest_only ? ChosenFeatures{*view.distances, 0, 1} : ChosenFeatures{*view.distances},
                              {view.sensitivities, view.agents, view.points}, leader, features);
        return features;
      },
      py::arg("observation"), py::arg("agents"), py::arg("leader") = 0, py::arg("nearest_only") = false,
      "Features of the object itself with the gradients of its quasi-static equilibrium. Raises ValueError.");
}
