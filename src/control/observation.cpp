#include "deformable_manipulation/control/observation.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <sstream>

namespace deformable_manipulation {
namespace control {

namespace {

//! Whether all numbers are finite: a sum of numbers, each times zero, is zero only then.
bool areFinite(const double* values, long count) {
  return (0.0 * Eigen::Map<const Eigen::ArrayXd>(values, count)).sum() == 0.0;
}

bool areWithin(const int* values, long count, int least, int most) {
  return std::all_of(values, values + count, [=](int value) { return least <= value && value <= most; });
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
  const DistancesView& d = o.distances;
  const long vectors = 3L * d.features;
  const long coordinates = 3L * o.copies * o.points;
  for (const Field& field :
       {Field{"positions", o.positions, 3L * o.agents}, Field{"velocities", o.velocities, 3L * o.agents},
        Field{"points", o.coordinates, coordinates}, Field{"displacements", o.displacements, 3L * o.copies},
        Field{"distances.distance", d.distance, d.features}, Field{"distances.normal", d.normal, vectors},
        Field{"distances.weights", d.weights, vectors},
        Field{"distances.obstacle_velocity", d.obstacle_velocity, vectors},
        Field{"sensitivities", o.sensitivities, 9L * o.agents * o.points}}) {
    if (field.values != nullptr && !areFinite(field.values, field.count)) {
      return std::string(field.name) + " of the state holds a number that is not finite";
    }
  }
  return "";
}

std::string wrongIndex(const ObservationView& o) {
  const DistancesView& d = o.distances;
  bool covered = d.offsets[0] == 0 && d.offsets[o.copies] == d.features;
  for (int copy = 0; copy < o.copies; ++copy) {
    covered = covered && d.offsets[copy] <= d.offsets[copy + 1];
  }
  if (!covered) {
    return "distances.offsets of the state do not cover its " + std::to_string(d.features) + " features";
  }
  if (!areWithin(d.vertices, 3L * d.features, 0, o.points - 1)) {
    return "distances.vertices of the state are outside 0 .. " + std::to_string(o.points - 1);
  }
  if (!areWithin(o.displaced_agents, o.copies, -1, o.agents - 1)) {
    return "displaced_agents of the state are outside -1 .. " + std::to_string(o.agents - 1);
  }
  return "";
}

//! A minimum is infinite, and only then, where a copy has no feature.
std::string wrongMinimum(const DistancesView& d, int copies) {
  for (int copy = 0; copy < copies; ++copy) {
    const bool without = d.offsets[copy] == d.offsets[copy + 1];
    if (!std::isfinite(d.minimum[copy]) && !(without && d.minimum[copy] == std::numeric_limits<double>::infinity())) {
      return "distances.minimum of the state holds a number that is not finite";
    }
  }
  return "";
}

}  // namespace

std::string findFault(const ObservationView& observation) {
  std::string fault = notFinite(observation);
  if (fault.empty()) {
    fault = wrongIndex(observation);
  }
  return fault.empty() ? wrongMinimum(observation.distances, observation.copies) : fault;
}

}  // namespace control
}  // namespace deformable_manipulation
