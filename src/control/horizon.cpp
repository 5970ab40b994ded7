#include "deformable_manipulation/control/horizon.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace deformable_manipulation {
namespace control {
namespace {

// Behind a leader at two thirds of the assistants' velocity, departures count from the clipped law.
constexpr double FAST = 2.0 / 3.0;

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
  team.turns = false;  // grips are expected to keep their orientations
  return team;
}

//! How far beyond the velocity the law is, per axis: 0 within it, 1 where it wants to be twice as fast.
Vector3 saturationOf(const Vector3& law, double max_velocity) {
  const auto excess = (law.cwiseAbs().array() - max_velocity) / std::max(max_velocity, 1e-9);
  return excess.max(0.0).min(1.0);
}

Vector3 within(double most, const Vector3& velocity) { return velocity.cwiseMax(-most).cwiseMin(most); }

//! The barriers' priorities after a first kind of rows, which is numbered after theirs.
Priority afterFirst(const Priority& priority) {
  Priority result{static_cast<int>(priority.size())};
  result.insert(result.end(), priority.begin(), priority.end());
  return result;
}

}  // namespace

Horizon::Horizon(const ControllerParameters& parameters, std::shared_ptr<ObjectForecast> forecast)
    : leader_forecast_(parameters.horizon), forecast_(std::move(forecast)) {
  setParameters(parameters);
}

void Horizon::setParameters(const ControllerParameters& p) {
  parameters_ = p.horizon;
  leader_forecast_.setParameters(p.horizon);
  forecast_->setObstacleDoubt(p.horizon.obstacle_doubt);
  team_ = commandingAll(p, p.horizon.length);
  max_velocity_ = p.max_velocity;
  change_ = p.smoothing > 0.0 ? 1.0 - std::exp(-p.cycle_time / p.smoothing) : 1.0;
  weights_at_rest_ = p.weights;
  interval_ = p.horizon.length / p.horizon.nodes;
  times_.resize(p.horizon.nodes);
  gain_ = (1.0 - std::exp(-p.gain * interval_)) / interval_;
  barriers_ = makeBarriers(p.barriers, demandingPositions(p), team_);
  const Eigen::VectorXd weights = p.horizon.weights.replicate(p.horizon.nodes * columns(), 1);
  filter_ = std::make_unique<SafetyFilter>(weights, afterFirst(p.priority), true);
  zero_.setZero(weights.size());
  if (departures_.size() != weights.size()) {
    reset();
  }
}

void Horizon::reset() {
  departures_.setZero(3 * parameters_.nodes * columns());
  leader_forecast_.reset();
  forecast_->reset();
  memories_.assign(parameters_.nodes, FeatureMemory());
}

void Horizon::plan(const ObservationView& observation, const PredictedState& predicted,
                   const std::vector<Follower>& followers) {
  leader_forecast_.look(observation, predicted);
  const double speed = leader_forecast_.fastest() / max_velocity_;
  haste_ = std::min(1.0, speed);
  clipping_ = std::min(1.0, speed / FAST);
  follow(predicted, followers);
  displace();
  hold(observation.agents);
  for (int node = 0; node < parameters_.nodes; ++node) {
    const bool known = team_.formulation.obstacle_velocity;
    times_[node] = observation.time + (known ? predicted.delay + timeOf(node) : 0.0);
  }
  forecast_->look(observation, held_, times_);
  rows_.clear(static_cast<int>(departures_.size()));
  unhindered_ = true;
  for (int node = 0; node < parameters_.nodes; ++node) {
    addLimits(node, observation.time);
  }
  departures_ += change_ * ((unhindered_ ? zero_ : best()) - departures_);
}

//! What becomes of the assistants by the last plan and, to first order, by the law within their velocity alone.
void Horizon::follow(const PredictedState& predicted, const std::vector<Follower>& followers) {
  const std::vector<Vector3>& leader = leader_forecast_.positions();
  paths_.resize(columns());
  free_.resize(departures_.size());
  from_law_.resize(departures_.size());
  for (int column = 0; column < columns(); ++column) {
    const int agent = team_.commanded[column];
    Path& path = paths_[column];
    path.max_velocity = followers[agent].follows ? max_velocity_ : 0.0;
    path.positions.assign(1, predicted.positions[agent]);
    path.velocities.clear();
    path.law.clear();
    path.pulls.clear();
    Vector3 free = Vector3::Zero();
    for (int node = 0; node < parameters_.nodes; ++node) {
      const Vector3 ahead = (leader[node + 1] - leader[node]) / interval_;
      const Vector3 goal = leader[node] + followers[agent].place;
      const auto variables = variable(node, column);
      const Vector3 law = ahead + gain_ * (goal - path.positions[node]);
      const Vector3 clipped = within(path.max_velocity, law);
      path.law.push_back(law + clipping_ * (clipped - law));
      path.pulls.push_back(gain_ * (1.0 - clipping_ * saturationOf(law, path.max_velocity).array()));
      path.velocities.push_back(within(path.max_velocity, Vector3(clipped + departures_.segment<3>(variables))));
      path.positions.push_back(path.positions[node] + interval_ * path.velocities[node]);
      from_law_.segment<3>(variables) = path.velocities[node] - path.law[node];
      const Vector3 unhindered = within(path.max_velocity, lawAt(path, node, free));
      free += interval_ * (unhindered - path.velocities[node]);
      free_.segment<3>(variables) = free;
    }
  }
}

//! [m/s] The law in an interval that begins displaced from the last plan, to first order.
Vector3 Horizon::lawAt(const Path& path, int node, const Vector3& displacement) {
  return path.law[node] - path.pulls[node].cwiseProduct(displacement);
}

//! What is left of each departure at each node, and what that makes for the last plan's ones.
void Horizon::displace() {
  displaced_.setZero(departures_.size());
  const int nodes = parameters_.nodes;
  for (int column = 0; column < columns(); ++column) {
    Path& path = paths_[column];
    path.kept.assign(static_cast<std::size_t>(nodes) * nodes, Vector3::Zero());
    for (int node = 0; node < nodes; ++node) {
      const Vector3 left = Vector3::Ones() - interval_ * path.pulls[node];
      path.kept[node * nodes + node].setConstant(interval_);
      for (int from = 0; from < node; ++from) {
        path.kept[from * nodes + node] = left.cwiseProduct(path.kept[from * nodes + node - 1]);
      }
      for (int from = 0; from <= node; ++from) {
        displaced_.segment<3>(variable(node, column)) +=
            path.kept[from * nodes + node].cwiseProduct(from_law_.segment<3>(variable(from, column)));
      }
    }
  }
}

//! Where all agents hold the object, by the last plan.
void Horizon::hold(int agents) {
  held_.resize(static_cast<std::size_t>(parameters_.nodes) * agents);
  for (int node = 0; node < parameters_.nodes; ++node) {
    Vector3* held = &held_[static_cast<std::size_t>(node) * agents];
    held[team_.leader] = leader_forecast_.positions()[node + 1];
    for (int column = 0; column < columns(); ++column) {
      held[team_.commanded[column]] = paths_[column].positions[node + 1];
    }
  }
}

//! The barriers at a node, as rows on all departures before it.
void Horizon::addLimits(int node, double time) {
  PredictedState there;
  there.leader = team_.leader;
  there.positions.assign(held_.begin() + static_cast<std::ptrdiff_t>(node) * team_.agents,
                         held_.begin() + static_cast<std::ptrdiff_t>(node + 1) * team_.agents);
  there.velocities.assign(there.positions.size(), Vector3::Zero());
  there.shape = forecast_->shape(node);
  forecast_->takeFeatures(node, team_.leader, features_);
  memories_[node].recall(time, there.positions.data(), features_);
  for (int m = 0; m < features_.size(); ++m) {
    features_.distance[m] -= timeOf(node) * leader_forecast_.doubt(node);
  }
  const Eigen::Index width = 3 * columns();
  node_rows_.clear(static_cast<int>(width));
  for (std::size_t k = 0; k < barriers_.size(); ++k) {
    BarrierRows rows(node_rows_, static_cast<int>(k), -1);
    barriers_[k]->addRows(features_, there, rows);
  }
  const double scale = 1.0 / timeOf(node);  // rows of velocities, as the filter expects them
  for (int r = 0; r < node_rows_.size(); ++r) {
    const auto g = node_rows_.coefficients(r);
    unhindered_ = unhindered_ && g.dot(free_.segment(node * width, width)) >= node_rows_.bound(r);
    const double bound = node_rows_.bound(r) + g.dot(displaced_.segment(node * width, width));
    auto row = rows_.add(node_rows_.kind(r), scale * bound);
    for (int column = 0; column < columns(); ++column) {
      for (int from = 0; from <= node; ++from) {
        row.segment<3>(variable(from, column)) =
            scale * paths_[column].kept[from * parameters_.nodes + node].cwiseProduct(g.segment<3>(3 * column));
      }
    }
  }
}

//! The assistants' velocities stay within their limit.
void Horizon::addVelocities() {
  const int kind = static_cast<int>(barriers_.size());
  for (int node = 0; node < parameters_.nodes; ++node) {
    for (int column = 0; column < columns(); ++column) {
      const Path& path = paths_[column];
      for (int k = 0; k < 6; ++k) {
        const int axis = k / 2;
        const double sign = k % 2 == 0 ? 1.0 : -1.0;
        const double pull = path.pulls[node][axis];
        const double before = node > 0 ? displaced_[variable(node - 1, column) + axis] : 0.0;
        auto row = rows_.add(kind, -path.max_velocity - sign * (path.law[node][axis] + pull * before));
        row[variable(node, column) + axis] = sign;
        for (int from = 0; from < node; ++from) {
          const double kept = path.kept[from * parameters_.nodes + node - 1][axis];
          row[variable(from, column) + axis] = -sign * pull * kept;
        }
      }
    }
  }
}

//! The plan of least cost that keeps the limits, as departures from the law within its velocity.
const Eigen::VectorXd& Horizon::best() {
  addVelocities();
  weigh();
  reach();
  const Filtered& filtered = filter_->filter(zero_, rows_, lower_, upper_);
  if (filtered.status == Status::FAILED) {
    return zero_;
  }
  best_ = filtered.velocity;
  for (int column = 0; column < columns(); ++column) {
    const Path& path = paths_[column];
    Vector3 displacement = Vector3::Zero();
    for (int node = 0; node < parameters_.nodes; ++node) {
      auto departure = best_.segment<3>(variable(node, column));
      const Vector3 law = lawAt(path, node, displacement);
      const Vector3 velocity = law + departure;
      displacement += interval_ * (velocity - path.velocities[node]);
      departure = velocity - within(path.max_velocity, law);
    }
  }
  return best_;
}

//! Departures by up to twice the velocity from what the law asks for within it.
void Horizon::reach() {
  lower_.resize(departures_.size());
  upper_.resize(departures_.size());
  for (int node = 0; node < parameters_.nodes; ++node) {
    for (int column = 0; column < columns(); ++column) {
      const Path& path = paths_[column];
      const Vector3 middle = within(path.max_velocity, path.law[node]) - path.law[node];
      lower_.segment<3>(variable(node, column)) = middle.array() - 2.0 * max_velocity_;
      upper_.segment<3>(variable(node, column)) = middle.array() + 2.0 * max_velocity_;
    }
  }
}

//! The faster the leader, the more it counts that there is a way back.
void Horizon::weigh() {
  const Vector3 weights = (1.0 - haste_) * weights_at_rest_ + haste_ * parameters_.weights;
  filter_->setWeights(weights.replicate(parameters_.nodes * columns(), 1));
}

Vector3 Horizon::departure(int agent) const { return departures_.segment<3>(variable(0, team_.columnOf(agent))); }

}  // namespace control
}  // namespace deformable_manipulation
