#include "deformable_manipulation/control/barriers/collision_barrier.h"

#include <algorithm>

namespace deformable_manipulation {
namespace control {

namespace {

// Squared gradient [1] below which an assistant has no say in a feature's distance: the shares then turn to
// equal ones, smoothly.
constexpr double NEGLIGIBLE = 1e-6;

// Part of the copies' parting by which the margin grows.
constexpr double PARTING_SHARE = 0.3;

// Part of the band beyond which rows begin to loosen.
constexpr double FULL_PART = 0.7;

//! 0 up to the inner part of the band, 1 from its edge on, smooth in between.
double looseness(double beyond_nearest, double band) {
  const double edge = std::max(band, 1e-9);
  const double x = std::clamp((beyond_nearest / edge - FULL_PART) / (1.0 - FULL_PART), 0.0, 1.0);
  return x * x * (3.0 - 2.0 * x);
}

double sumOfSquares(const Features& features, int feature, const std::vector<int>& agents) {
  double sum = 0.0;
  for (const int agent : agents) {
    sum += features.gradient(feature, agent).squaredNorm() + NEGLIGIBLE;
    if (features.haveTurns()) {
      sum += features.turn(feature, agent).squaredNorm();
    }
  }
  return sum;
}

}  // namespace

CollisionParameters CollisionParameters::read(const ParameterSection& collision) {
  return {collision.number("offset"),
          collision.number("margin"),
          collision.number("speed_margin"),
          collision.number("snap_margin"),
          collision.number("band"),
          PiecewiseLinearClassK::read(collision, "alpha"),
          PiecewiseLinearClassK::read(collision, "anticipation")};
}

double CollisionBarrier::value(const PresentState& state, int /*agent*/) const {
  return state.distance - parameters_.offset;
}

void CollisionBarrier::addRows(const Features& features, const PredictedState& state, BarrierRows& rows) const {
  const Vector3 leader_velocity = leaderVelocity(state);
  const double margin = parameters_.margin + parameters_.speed_margin * leader_velocity.norm();
  for (int m = 0; m < features.size(); ++m) {
    Vector3 g = Vector3::Zero();  // of all commanded ones together
    double reach = 0.0;           // [m/s] that they can move the feature by
    for (const int agent : team_.commanded) {
      g += features.gradient(m, agent);
      reach += team_.max_velocity * features.gradient(m, agent).lpNorm<1>();
    }
    const double snap = std::min(PARTING_SHARE * features.parting[m], parameters_.snap_margin);
    const double h = predictedDistance(features, m, state) - parameters_.offset - margin - snap;
    double carried = features.normal[m].dot(leader_velocity - obstacleVelocity(features, m)) +
                     std::min(0.0, features.disturbance[m]);
    if (team_.turns && features.haveTurns()) {
      carried += features.turn(m, team_.leader).dot(state.angular_velocities[team_.leader]);
      for (const int agent : team_.commanded) {
        reach += team_.max_angular_velocity * features.turn(m, agent).lpNorm<1>();
      }
    }
    const double share = team_.formulation.shares ? shareOf(features, m) : 1.0;
    const double loose = looseness(features.distance[m] - features.distance[0], parameters_.band);
    const auto boundOf = [&](const PiecewiseLinearClassK& alpha) {
      const double bound = g.dot(leader_velocity) - share * (carried + alpha(h));
      return bound - loose * std::max(0.0, bound + reach);  // every velocity satisfies -reach
    };
    const auto fill = [&](Eigen::Map<Eigen::VectorXd> row) {
      for (std::size_t i = 0; i < team_.commanded.size(); ++i) {
        row.segment<3>(3 * i) = features.gradient(m, team_.commanded[i]);
        if (team_.turns && features.haveTurns()) {
          row.segment<3>(team_.turnOf(static_cast<int>(i))) = features.turn(m, team_.commanded[i]);
        }
      }
    };
    fill(rows.limit(boundOf(parameters_.alpha)));
    if (team_.formulation.anticipation) {
      fill(rows.anticipate(boundOf(parameters_.anticipation)));
    }
  }
}

Vector3 CollisionBarrier::leaderVelocity(const PredictedState& state) const {
  return team_.formulation.leader_velocity ? state.leaderVelocity() : Vector3::Zero();
}

Vector3 CollisionBarrier::obstacleVelocity(const Features& features, int feature) const {
  return team_.formulation.obstacle_velocity ? features.obstacle_velocity[feature] : Vector3::Zero();
}

//! Distance [m] when the command starts to act, to first order.
double CollisionBarrier::predictedDistance(const Features& features, int feature, const PredictedState& state) const {
  const Vector3 leader_velocity = leaderVelocity(state);
  double rate = features.normal[feature].dot(leader_velocity - obstacleVelocity(features, feature)) +
                std::min(0.0, features.disturbance[feature]);
  for (const int assistant : team_.assistants) {
    rate += features.gradient(feature, assistant).dot(state.velocities[assistant] - leader_velocity);
  }
  for (int agent = 0; team_.turns && features.haveTurns() && agent < features.agents(); ++agent) {
    rate += features.turn(feature, agent).dot(state.angular_velocities[agent]);
  }
  return features.distance[feature] + state.delay * rate;
}

//! The part of a feature's demand that the commanded assistants take.
double CollisionBarrier::shareOf(const Features& features, int feature) const {
  return sumOfSquares(features, feature, team_.commanded) / sumOfSquares(features, feature, team_.assistants);
}

namespace barriers {

std::unique_ptr<Barrier> collision(const ParameterSection& section, const Team& team) {
  return std::make_unique<CollisionBarrier>(CollisionParameters::read(section), team);
}

}  // namespace barriers

}  // namespace control
}  // namespace deformable_manipulation
