#include "deformable_manipulation/control/shape_observer.h"

namespace deformable_manipulation {
namespace control {

ObjectShape presentShape(const ObservationView& observation) {
  ObjectShape shape;
  shape.agents = observation.agents;
  shape.points = observation.points;
  shape.coordinates = observation.coordinates;
  shape.orientations = observation.orientations;
  shape.wrenches = observation.wrenches;
  return shape;
}

ObjectShape ShapeObserver::observe(const ObservationView& observation, const Differences& differences, bool exact) {
  ObjectShape shape = presentShape(observation);
  if (exact) {
    shape.response = observation.sensitivities;
    shape.turning = observation.turning_sensitivities;
    shape.wrench_response = observation.wrench_sensitivities;
  } else {
    differences.takeResponse(response_);
    shape.response = response_.data();
  }
  if (shape.wrench_response == nullptr && differences.tellWrenches()) {
    differences.takeWrenchResponse(wrench_response_);
    shape.wrench_response = wrench_response_.data();
  }
  return shape;
}

}  // namespace control
}  // namespace deformable_manipulation
