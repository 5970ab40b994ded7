#include "deformable_manipulation/control/gradients.h"

namespace deformable_manipulation {
namespace control {

Gradients::Gradients(const ControllerParameters& p)
    : team_(p.team),
      prefers_exact_(p.exact_gradients),
      differences_(p.team.agents, p.team.leader),
      disturbances_(p.disturbance_filter) {}

void Gradients::setParameters(const ControllerParameters& p) {
  prefers_exact_ = p.exact_gradients;
  disturbances_.setTimeConstant(p.disturbance_filter);
}

void Gradients::reset() {
  differences_.reset();
  disturbances_.reset();
}

void Gradients::find(const ObservationView& observation, const std::vector<Vector3>& velocities) {
  exact_ = prefers_exact_ && observation.sensitivities != nullptr;
  take(observation);
  disturbances_.update(observation.time, velocities, team_.formulation.obstacle_velocity, features_);
}

void Gradients::take(const ObservationView& observation) {
  const bool nearest_only = !team_.formulation.every_feature;
  if (exact_) {
    ChosenFeatures chosen{*observation.distances};
    if (nearest_only) {
      chosen.most = 1;
    }
    const double* turns = team_.turns ? observation.turning_sensitivities : nullptr;
    takeResponseGradients(chosen, {observation.sensitivities, observation.agents, observation.points, turns},
                          team_.leader, features_);
  } else if (nearest_only) {
    differences_.takeMinimum(*observation.distances, features_);
  } else {
    differences_.takeGradients(observation, features_);
  }
}

const std::vector<double>& Gradients::response(const ObservationView& observation) {
  if (exact_) {
    response_.assign(observation.sensitivities,
                     observation.sensitivities + 9 * observation.agents * observation.points);
  } else {
    differences_.takeResponse(response_);
  }
  return response_;
}

}  // namespace control
}  // namespace deformable_manipulation
