#include "deformable_manipulation/control/horizon.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace deformable_manipulation {
namespace control {
namespace {

//! The section of the controller with barriers that demand h(displaced) >= 0 where they demand dh/dt >= -alpha(h).
ParameterValue demandingPositions(const ControllerParameters& p) {
  ParameterValue::Mapping controller = *p.values.as<ParameterValue::Mapping>();
  for (const std::string& name : p.barriers) {
    ParameterValue::Mapping section = *controller[name].as<ParameterValue::Mapping>();
    section["alpha"] = ParameterValue::List{1.0, 1.0};
    controller[name] = section;
  }
  return controller;
}

Team commandingAll(const ControllerParameters& p, double length) {
  Team team = p.team;
  team.commanded = team.assistants;
  team.max_velocity = 2.0 * p.max_velocity * length;  // of displacements
  team.formulation.anticipation = false;
  return team;
}

//! The barriers' priorities after a first kind of rows, which is numbered after theirs.
Priority afterFirst(const Priority& priority) {
  Priority result{static_cast<int>(priority.size())};
  result.insert(result.end(), priority.begin(), priority.end());
  return result;
}

}  // namespace

Horizon::Horizon(const ControllerParameters& parameters, std::shared_ptr<ObjectForecast> forecast)
    : forecast_(std::move(forecast)) {
  setParameters(parameters);
}

void Horizon::setParameters(const ControllerParameters& p) {
  parameters_ = p.horizon;
  team_ = commandingAll(p, p.horizon.length);
  interval_ = p.horizon.length / p.horizon.nodes;
  kept_ = std::exp(-p.gain * interval_);
  gain_ = (1.0 - kept_) / interval_;
  barriers_ = makeBarriers(p.barriers, demandingPositions(p), team_);
  const Eigen::VectorXd weights = p.horizon.weights.replicate(p.horizon.nodes * columns(), 1);
  filter_ = std::make_unique<SafetyFilter>(weights, afterFirst(p.priority), true);
  parameters_.max_velocity = p.max_velocity;
  reach_.setConstant(weights.size(), 2.0 * p.max_velocity);
  zero_.setZero(weights.size());
  if (departures_.size() != weights.size()) {
    reset();
  }
}

void Horizon::reset() {
  departures_.setZero(3 * parameters_.nodes * columns());
}

//! What is left at the end of interval `to` of a displacement made in interval `from` [s].
double Horizon::carried(int from, int to) const { return interval_ * std::pow(kept_, to - from); }

void Horizon::plan(const ObservationView& observation, const PredictedState& predicted,
                   const std::vector<Vector3>& places) {
  follow(predicted, places);
  displace();
  held_.resize(static_cast<std::size_t>(parameters_.nodes) * observation.agents);
  for (int node = 0; node < parameters_.nodes; ++node) {
    Vector3* held = &held_[static_cast<std::size_t>(node) * observation.agents];
    held[team_.leader] = leader_[node + 1];
    for (int column = 0; column < columns(); ++column) {
      held[team_.commanded[column]] =
          followed_[column][node + 1] + displaced_.segment<3>(variable(node, column));
    }
  }
  forecast_->look(observation, held_);
  rows_.clear(static_cast<int>(departures_.size()));
  for (int node = 0; node < parameters_.nodes; ++node) {
    addLimits(node);
  }
  addVelocities();
  const Filtered& result = filter_->filter(zero_, rows_, -reach_, reach_);
  departures_ = result.velocity;
}

//! Where the leader is expected, and the assistants by the nominal law within their velocity.
void Horizon::follow(const PredictedState& predicted, const std::vector<Vector3>& places) {
  const int nodes = parameters_.nodes;
  leader_.assign(1, predicted.positions[team_.leader]);
  for (int node = 0; node < nodes; ++node) {
    const double faded = parameters_.leader_fade * (1.0 - std::exp(-timeOf(node) / parameters_.leader_fade));
    leader_.push_back(leader_[0] + (announced_.empty() ? faded * predicted.leaderVelocity() : announced_[node]));
  }
  announced_.clear();
  followed_.resize(columns());
  speeds_.resize(columns());
  for (int column = 0; column < columns(); ++column) {
    const int agent = team_.commanded[column];
    std::vector<Vector3>& path = followed_[column];
    path.assign(1, predicted.positions[agent]);
    speeds_[column].clear();
    for (int node = 0; node < nodes; ++node) {
      const Vector3 error = leader_[node] + places[agent] - path[node];
      const Vector3 wished = (leader_[node + 1] - leader_[node]) / interval_ + gain_ * error;
      speeds_[column].push_back(wished.cwiseMax(-parameters_.max_velocity).cwiseMin(parameters_.max_velocity));
      path.push_back(path[node] + interval_ * speeds_[column][node]);
    }
  }
}

//! How far the last plan's departures lead away from what the nominal law does.
void Horizon::displace() {
  displaced_.setZero(departures_.size());
  const Eigen::Index width = 3 * columns();
  for (int node = 0; node < parameters_.nodes; ++node) {
    displaced_.segment(node * width, width) = interval_ * departures_.segment(node * width, width);
    if (node > 0) {
      displaced_.segment(node * width, width) += kept_ * displaced_.segment((node - 1) * width, width);
    }
  }
}

//! The barriers at a node, on all departures before it.
void Horizon::addLimits(int node) {
  PredictedState there;
  there.leader = team_.leader;
  there.positions.assign(held_.begin() + static_cast<std::ptrdiff_t>(node) * team_.agents,
                         held_.begin() + static_cast<std::ptrdiff_t>(node + 1) * team_.agents);
  there.velocities.assign(there.positions.size(), Vector3::Zero());
  forecast_->takeFeatures(node, team_.leader, features_);
  for (int m = 0; m < features_.size(); ++m) {
    features_.distance[m] -= timeOf(node) * features_.normal[m].dot(features_.obstacle_velocity[m]);
    features_.obstacle_velocity[m].setZero();
  }
  const Eigen::Index width = 3 * columns();
  node_rows_.clear(static_cast<int>(width));
  for (std::size_t k = 0; k < barriers_.size(); ++k) {
    BarrierRows rows(node_rows_, static_cast<int>(k), -1);
    barriers_[k]->addRows(features_, there, rows);
  }
  const double scale = 1.0 / timeOf(node);
  for (int r = 0; r < node_rows_.size(); ++r) {
    const auto g = node_rows_.coefficients(r);
    const double bound = node_rows_.bound(r) + g.dot(displaced_.segment(node * width, width));
    auto row = rows_.add(node_rows_.kind(r), scale * bound);
    for (int from = 0; from <= node; ++from) {
      row.segment(from * width, width) = scale * carried(from, node) * g;
    }
  }
}

//! The assistants' velocities stay within their limit.
void Horizon::addVelocities() {
  const int kind = static_cast<int>(barriers_.size());
  for (int node = 0; node < parameters_.nodes; ++node) {
    for (int column = 0; column < columns(); ++column) {
      for (int axis = 0; axis < 3; ++axis) {
        for (const double sign : {1.0, -1.0}) {
          auto row = rows_.add(kind, -parameters_.max_velocity - sign * speeds_[column][node][axis]);
          row[variable(node, column) + axis] = sign;
          for (int from = 0; from < node; ++from) {
            row[variable(from, column) + axis] = -sign * gain_ * carried(from, node - 1);
          }
        }
      }
    }
  }
}

Vector3 Horizon::departure(int agent) const { return departures_.segment<3>(variable(0, team_.columnOf(agent))); }

}  // namespace control
}  // namespace deformable_manipulation
