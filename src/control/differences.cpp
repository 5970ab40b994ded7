#include "deformable_manipulation/control/differences.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace deformable_manipulation {
namespace control {

namespace {

constexpr double SMALLEST_DISPLACEMENT = 1e-6;  // m, below which a difference is rounding

Eigen::Index wrenchNumbers(const ObservationView& observation) {
  return observation.wrenches != nullptr ? 6L * observation.agents : 0;
}

double finiteMinimum(const distance::Distances& distances, int copy) {
  return std::isfinite(distances.minimum[copy]) ? distances.minimum[copy] : 0.0;
}

}  // namespace

Differences::Differences(int agents, int leader) : leader_(leader), agents_(static_cast<std::size_t>(agents)) {}

void Differences::reset() { agents_.assign(agents_.size(), Agent{}); }

void Differences::update(const ObservationView& observation) {
  const Eigen::Index columns = 3L * observation.points + wrenchNumbers(observation) + 1;
  points_ = observation.points;
  for (std::size_t agent = 0; agent < agents_.size(); ++agent) {
    if (agents_[agent].rates.cols() != columns) {
      agents_[agent] = Agent{};
      agents_[agent].rates.setZero(3, columns);
    }
    if (static_cast<int>(agent) != leader_) {
      updateAgent(static_cast<int>(agent), observation);
    }
  }
}

void Differences::updateAgent(int index, const ObservationView& observation) {
  Agent& agent = agents_[index];
  int own = 0;
  usable_.clear();
  for (int copy = 0; copy < observation.copies; ++copy) {
    if (observation.displaced_agents[copy] != index) {
      continue;
    }
    ++own;
    if (isUsable(observation, copy)) {
      usable_.push_back(copy);
    }
  }
  if (own == 0) {
    agent.known = false;
    agent.rates.setZero();
  } else if (!usable_.empty()) {
    agent.known = agent.known || static_cast<int>(usable_.size()) == own;
    fill(agent, observation);
  }
}

//! Rates that the usable copies tell: R <- R + D^+ (change - D R).
void Differences::fill(Agent& agent, const ObservationView& observation) {
  const Eigen::Index size = 3L * observation.points;
  const Eigen::Index wrenches = wrenchNumbers(observation);
  const auto coordinates = [&](int copy) {
    return Eigen::Map<const Eigen::RowVectorXd>(observation.coordinates + copy * size, size);
  };
  const auto wrenchesOf = [&](int copy) {
    return Eigen::Map<const Eigen::RowVectorXd>(observation.wrenches + copy * wrenches, wrenches);
  };
  const auto count = static_cast<Eigen::Index>(usable_.size());
  directions_.resize(count, 3);
  change_.resize(count, size + wrenches + 1);
  for (Eigen::Index i = 0; i < count; ++i) {
    const int copy = usable_[i];
    directions_.row(i) = Eigen::Map<const Vector3>(observation.displacements + 3 * copy).transpose();
    change_.row(i).head(size) = coordinates(copy) - coordinates(0);
    if (wrenches > 0) {
      change_.row(i).segment(size, wrenches) = wrenchesOf(copy) - wrenchesOf(0);
    }
    change_(i, size + wrenches) =
        finiteMinimum(*observation.distances, copy) - finiteMinimum(*observation.distances, 0);
    for (int axis = 0; axis < 3; ++axis) {
      change_.row(i) -= directions_(i, axis) * agent.rates.row(axis);
    }
  }
  if (agent.directions.rows() != count || agent.directions != directions_) {
    agent.directions = directions_;
    agent.inverse = directions_.completeOrthogonalDecomposition().pseudoInverse();
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (Eigen::Index i = 0; i < count; ++i) {
      agent.rates.row(axis) += agent.inverse(axis, i) * change_.row(i);
    }
  }
}

bool Differences::isUsable(const ObservationView& observation, int copy) const {
  const int agent = observation.displaced_agents[copy];
  const Eigen::Map<const Vector3> displacement(observation.displacements + 3 * copy);
  return agent >= 0 && agent != leader_ && observation.ready[copy] &&
         displacement.cwiseAbs().maxCoeff() > SMALLEST_DISPLACEMENT;
}

void Differences::takeResponse(std::vector<double>& to) const {
  using Derivative = Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;
  const Eigen::Index points = points_;
  to.resize(9 * points * agents_.size());
  for (Eigen::Index point = 0; point < points; ++point) {
    Derivative leader(&to[9 * (leader_ * points + point)]);
    leader.setIdentity();
    for (std::size_t agent = 0; agent < agents_.size(); ++agent) {
      if (static_cast<int>(agent) != leader_) {
        Derivative derivative(&to[9 * (agent * points + point)]);
        derivative = agents_[agent].rates.middleCols<3>(3 * point).transpose();
        leader -= derivative;
      }
    }
  }
}

void Differences::takeWrenchResponse(std::vector<double>& to) const {
  const std::size_t agents = agents_.size();
  to.assign(36 * agents * agents, 0.0);
  for (std::size_t number = 0; number < 6 * agents; ++number) {
    Vector3 rest = Vector3::Zero();
    for (std::size_t agent = 0; agent < agents; ++agent) {
      if (static_cast<int>(agent) != leader_) {
        const Vector3 rates = agents_[agent].rates.col(3L * points_ + static_cast<Eigen::Index>(number));
        Eigen::Map<Vector3>{&to[6 * (number * agents + agent)]} = rates;
        rest -= rates;
      }
    }
    Eigen::Map<Vector3>{&to[6 * (number * agents + leader_)]} = rest;
  }
}

void Differences::takeGradients(const ObservationView& observation, Features& features) const {
  const distance::Distances& distances = *observation.distances;
  features.take({distances}, static_cast<int>(agents_.size()));
  for (int m = 0; m < features.size(); ++m) {
    const distance::Feature& feature = distances.features[m];
    for (int agent = 0; agent < features.agents(); ++agent) {
      for (int k = 0; k < 3 && agent != leader_; ++k) {
        const auto rates = agents_[agent].rates.middleCols<3>(3L * feature.vertices[k]);
        features.gradient(m, agent) += feature.weights[k] * (rates * features.normal[m]);
      }
    }
  }
  takePartings(observation, features);
  features.completeLeader(leader_);
}

//! The greatest parting of all copies along each feature's normal.
void Differences::takePartings(const ObservationView& observation, Features& features) const {
  const Eigen::Index size = 3L * observation.points;
  for (int copy = 0; copy < observation.copies; ++copy) {
    if (!isUsable(observation, copy)) {
      continue;
    }
    const int agent = observation.displaced_agents[copy];
    const Eigen::Map<const Vector3> displacement(observation.displacements + 3 * copy);
    for (int m = 0; m < features.size(); ++m) {
      const distance::Feature& feature = observation.distances->features[m];
      double parting = -displacement.dot(features.gradient(m, agent));
      for (int k = 0; k < 3; ++k) {
        const double* vertex = observation.coordinates + 3L * feature.vertices[k];
        const Eigen::Map<const Vector3> now(vertex), displaced(vertex + copy * size);
        parting += feature.weights[k] * (displaced - now).dot(features.normal[m]);
      }
      features.parting[m] = std::max(features.parting[m], std::abs(parting));
    }
  }
}

void Differences::takeMinimum(const distance::Distances& distances, Features& features) const {
  features.take({distances, 0, 1}, static_cast<int>(agents_.size()));
  for (int agent = 0; agent < features.agents() && features.size() > 0; ++agent) {
    if (agent != leader_) {
      features.gradient(0, agent) = agents_[agent].rates.rightCols<1>();
    }
  }
  features.completeLeader(leader_);
}

}  // namespace control
}  // namespace deformable_manipulation
