#include "deformable_manipulation/control/observation.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <sstream>

namespace deformable_manipulation {
namespace control {

namespace {

constexpr double UNIT_NORM = 1e-3;  // quaternions this near to unit norm are normalised

//! Whether all numbers are finite: a sum of numbers, each times zero, is zero only then.
bool areFinite(const double* values, long count) {
  return (0.0 * Eigen::Map<const Eigen::ArrayXd>(values, count)).sum() == 0.0;
}

std::string notFinite(const ObservationView& o) {
  if (!std::isfinite(o.time)) {
    std::ostringstream text;
    text << "time of the state is " << o.time << ", not a finite number";
    return text.str();
  }
  if (!(o.lateness >= 0.0) || !std::isfinite(o.lateness)) {
    std::ostringstream text;
    text << "lateness of the state is " << o.lateness << ", not a finite number of seconds, 0 or more";
    return text.str();
  }
  struct Field {
    const char* name;
    const double* values;
    long count;
  };
  const long coordinates = 3L * o.copies * o.points;
  for (const Field& field :
       {Field{"positions", o.positions, 3L * o.agents}, Field{"velocities", o.velocities, 3L * o.agents},
        Field{"points", o.coordinates, coordinates}, Field{"correction", o.correction, 3L * o.points},
        Field{"displacements", o.displacements, 3L * o.copies}, Field{"obstacles", o.obstacle_poses, 7L * o.obstacles},
        Field{"sensitivities", o.sensitivities, 9L * o.agents * o.points},
        Field{"turning_sensitivities", o.turning_sensitivities, 9L * o.agents * o.points},
        Field{"orientations", o.orientations, 4L * o.agents},
        Field{"angular_velocities", o.angular_velocities, 3L * o.agents},
        Field{"wrenches", o.wrenches, 6L * o.copies * o.agents},
        Field{"wrench_sensitivities", o.wrench_sensitivities, 36L * o.agents * o.agents}}) {
    if (field.values != nullptr && !areFinite(field.values, field.count)) {
      return std::string(field.name) + " of the state holds a number that is not finite";
    }
  }
  return "";
}

std::string notFinite(const distance::Distances& distances) {
  const auto fault = [](const char* name) {
    return std::string("distances.") + name + " of the state holds a number that is not finite";
  };
  for (const distance::Feature& feature : distances.features) {
    if (!std::isfinite(feature.distance)) {
      return fault("distance");
    }
    if (!feature.normal.allFinite()) {
      return fault("normal");
    }
    if (!areFinite(feature.weights.data(), 3)) {
      return fault("weights");
    }
    if (!feature.obstacle_velocity.allFinite()) {
      return fault("obstacle_velocity");
    }
  }
  return "";
}

std::string wrongOrientation(const ObservationView& o) {
  for (int agent = 0; o.orientations != nullptr && agent < o.agents; ++agent) {
    const double norm = Eigen::Map<const Eigen::Vector4d>(o.orientations + 4 * agent).norm();
    if (!(std::abs(norm - 1.0) < UNIT_NORM)) {
      std::ostringstream text;
      text << "orientations of the state holds a quaternion of norm " << norm << ", not 1";
      return text.str();
    }
  }
  return "";
}

std::string wrongIndex(const ObservationView& o) {
  const std::vector<int>& offsets = o.distances->offsets;
  const auto features = static_cast<int>(o.distances->features.size());
  if (offsets.size() != static_cast<std::size_t>(o.copies) + 1 || offsets.front() != 0 || offsets.back() != features ||
      !std::is_sorted(offsets.begin(), offsets.end())) {
    return "distances.offsets of the state do not cover the " + std::to_string(features) + " features of its " +
           std::to_string(o.copies) + " copies";
  }
  for (const distance::Feature& feature : o.distances->features) {
    for (const int vertex : feature.vertices) {
      if (vertex < 0 || vertex >= o.points) {
        return "distances.vertices of the state are outside 0 .. " + std::to_string(o.points - 1);
      }
    }
  }
  if (std::any_of(o.displaced_agents, o.displaced_agents + o.copies,
                  [&o](int agent) { return agent < -1 || agent >= o.agents; })) {
    return "displaced_agents of the state are outside -1 .. " + std::to_string(o.agents - 1);
  }
  return "";
}

//! A minimum is infinite, and only then, where a copy has no feature.
std::string wrongMinimum(const distance::Distances& d, int copies) {
  if (d.minimum.size() != static_cast<std::size_t>(copies)) {
    return "distances.minimum of the state has " + std::to_string(d.minimum.size()) + " numbers for " +
           std::to_string(copies) + " copies";
  }
  for (int copy = 0; copy < copies; ++copy) {
    const bool without = d.offsets[copy] == d.offsets[copy + 1];
    if (!std::isfinite(d.minimum[copy]) && !(without && d.minimum[copy] == std::numeric_limits<double>::infinity())) {
      return "distances.minimum of the state holds a number that is not finite";
    }
  }
  return "";
}

}  // namespace

std::vector<pbd::Quaternion> orientationsOf(const ObservationView& observation) {
  std::vector<pbd::Quaternion> orientations;
  for (int agent = 0; agent < observation.agents; ++agent) {
    orientations.push_back(Eigen::Map<const pbd::Quaternion>(observation.orientations + 4 * agent).normalized());
  }
  return orientations;
}

std::string findFault(const ObservationView& observation) {
  std::string fault = notFinite(observation);
  if (fault.empty()) {
    fault = wrongOrientation(observation);
  }
  if (fault.empty()) {
    fault = notFinite(*observation.distances);
  }
  if (fault.empty()) {
    fault = wrongIndex(observation);
  }
  return fault.empty() ? wrongMinimum(*observation.distances, observation.copies) : fault;
}

}  // namespace control
}  // namespace deformable_manipulation
