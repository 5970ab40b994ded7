#include "deformable_manipulation/control/team_program.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace deformable_manipulation {
namespace control {
namespace {

Eigen::VectorXd weightsOf(const ControllerParameters& parameters, const Team& team) {
  const auto members = static_cast<Eigen::Index>(team.commanded.size());
  Eigen::VectorXd weights(team.variables());
  weights.head(3 * members) = parameters.weights.replicate(members, 1);
  if (team.turns) {
    weights.tail(3 * members) = parameters.turning_weights.replicate(members, 1);
  }
  return weights;
}

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

TeamProgram::TeamProgram(const ControllerParameters& parameters, const Team& team)
    : barriers_(makeBarriers(parameters.barriers, parameters.values, team)),
      filter_(weightsOf(parameters, team), parameters.priority, team.formulation.relaxation) {
  for (Eigen::VectorXd* vector : {&nominal_, &lower_, &upper_}) {
    vector->setZero(team.variables());
  }
}

void TeamProgram::setParameters(const ControllerParameters& parameters, const Team& team) {
  std::vector<std::unique_ptr<Barrier>> barriers = makeBarriers(parameters.barriers, parameters.values, team);
  filter_.setWeights(weightsOf(parameters, team));
  barriers_ = std::move(barriers);
}

void TeamProgram::want(int first, const Vector3& nominal, const Vector3& lower, const Vector3& upper) {
  nominal_.segment<3>(first) = nominal;
  lower_.segment<3>(first) = lower;
  upper_.segment<3>(first) = upper;
}

bool TeamProgram::needsResponse() const {
  return std::any_of(barriers_.begin(), barriers_.end(), [](const auto& barrier) { return barrier->needsResponse(); });
}

const Filtered& TeamProgram::solve(const Features& features, const PredictedState& predicted) {
  rows_.clear(static_cast<int>(nominal_.size()));
  const int limits = static_cast<int>(barriers_.size());
  for (int k = 0; k < limits; ++k) {
    BarrierRows rows(rows_, k, limits);
    barriers_[k]->addRows(features, predicted, rows);
  }
  const auto start = std::chrono::steady_clock::now();
  const Filtered& result = filter_.filter(nominal_, rows_, lower_, upper_);
  solve_time_ = secondsSince(start);
  return result;
}

}  // namespace control
}  // namespace deformable_manipulation
