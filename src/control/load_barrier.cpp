#include "deformable_manipulation/control/load_barrier.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace deformable_manipulation {
namespace control {
namespace {

// A load that takes a longer way than this [m] to change by its limit is out of the agents' hands.
constexpr double LONGEST_WAY = 10.0;

double sumOfSquares(const std::vector<Vector6>& gradients, const std::vector<int>& agents) {
  double sum = 0.0;
  for (const int agent : agents) {
    sum += gradients[agent].squaredNorm();
  }
  return sum;
}

}  // namespace

LoadParameters LoadParameters::read(const ParameterSection& section, double limit) {
  return {limit, section.number("reserve"), PiecewiseLinearClassK::read(section, "alpha")};
}

LoadBarrier::LoadBarrier(const LoadParameters& parameters, const Team& team) : parameters_(parameters), team_(team) {
  gradients_.resize(static_cast<std::size_t>(team.agents));
}

bool LoadBarrier::concerns(int /*item*/, int /*agent*/) const { return true; }

//! How far the loads of an agent are within their limits, less a part of these.
double LoadBarrier::leastMargin(const PresentState& state, int agent, double reserve) const {
  double least = std::numeric_limits<double>::infinity();
  const int loads = count(state.shape);
  for (int item = 0; item < loads; ++item) {
    if (concerns(item, agent)) {
      least = std::min(least, (1.0 - reserve) * limit(item) - load(state.shape, item));
    }
  }
  return least;
}

double LoadBarrier::value(const PresentState& state, int agent) const { return leastMargin(state, agent, 0.0); }

double LoadBarrier::clearance(const PresentState& state, int agent) const {
  const bool kept = leastMargin(state, agent, parameters_.reserve) >= 0.0;
  return kept ? std::numeric_limits<double>::infinity() : -std::numeric_limits<double>::infinity();
}

//! Where grips do not turn, turns have no part in the gradients.
void LoadBarrier::addRows(const Features& /*features*/, const PredictedState& state, BarrierRows& rows) const {
  if (!isDifferentiable(state.shape)) {
    return;
  }
  const int loads = count(state.shape);
  for (int item = 0; item < loads; ++item) {
    std::fill(gradients_.begin(), gradients_.end(), Vector6::Zero());
    addGradient(state.shape, item, gradients_);
    for (Vector6& gradient : gradients_) {
      if (!team_.turns) {
        gradient.tail<3>().setZero();
      }
    }
    addRow(load(state.shape, item), limit(item), state, rows);
  }
}

//! The row of a load with the gradients computed last, unless every velocity satisfies it. It is scaled to gradients of
//! one, so that its slack is a velocity.
void LoadBarrier::addRow(double load, double limit, const PredictedState& state, BarrierRows& rows) const {
  const Vector3& leader_velocity = state.leaderVelocity();
  double rate = 0.0;  // of the load, by the predicted velocities
  for (const int assistant : team_.assistants) {
    rate += gradients_[assistant].head<3>().dot(state.velocities[assistant] - leader_velocity);
  }
  double turning = 0.0;  // of the load, by the leader's turning
  if (team_.turns) {
    turning = gradients_[team_.leader].tail<3>().dot(state.angular_velocities[team_.leader]);
    rate += turning;
    for (const int assistant : team_.assistants) {
      rate += gradients_[assistant].tail<3>().dot(state.angular_velocities[assistant]);
    }
  }
  const double all = sumOfSquares(gradients_, team_.assistants);
  const double own = sumOfSquares(gradients_, team_.commanded);
  const double share = team_.formulation.shares && all > 0.0 ? own / all : 1.0;
  const double h = (1.0 - parameters_.reserve) * limit - (load + state.delay * rate);
  double bound = -share * (parameters_.alpha(h) - turning);
  double reach = 0.0;  // that all velocities together can change it by, per second
  for (const int agent : team_.commanded) {
    bound -= gradients_[agent].head<3>().dot(leader_velocity);
    reach += team_.max_velocity * gradients_[agent].head<3>().lpNorm<1>();
    reach += team_.max_angular_velocity * gradients_[agent].tail<3>().lpNorm<1>();
  }
  if (bound <= -reach) {
    return;
  }
  const double scale = 1.0 / std::max(std::sqrt(own), limit / LONGEST_WAY);
  auto row = rows.limit(scale * bound);
  for (std::size_t i = 0; i < team_.commanded.size(); ++i) {
    const Vector6& gradient = gradients_[team_.commanded[i]];
    row.segment<3>(3 * i) = -scale * gradient.head<3>();
    if (team_.turns) {
      row.segment<3>(team_.turnOf(static_cast<int>(i))) = -scale * gradient.tail<3>();
    }
  }
}

}  // namespace control
}  // namespace deformable_manipulation
