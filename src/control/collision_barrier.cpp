#include "deformable_manipulation/control/collision_barrier.h"

#include <algorithm>
#include <utility>

namespace deformable_manipulation {
namespace control {

namespace {

// Squared gradient [1] below which an assistant has no say in a feature's distance: the shares then turn to
// equal ones, smoothly.
constexpr double NEGLIGIBLE = 1e-6;

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
  }
  return sum;
}

}  // namespace

CollisionBarrier::CollisionBarrier(std::vector<int> commanded, std::vector<int> assistants,
                                   const CollisionParameters& parameters, double max_velocity,
                                   const Formulation& formulation)
    : commanded_(std::move(commanded)),
      assistants_(std::move(assistants)),
      parameters_(parameters),
      max_velocity_(max_velocity),
      formulation_(formulation) {}

void CollisionBarrier::addRows(const Features& features, const Situation& situation, ConstraintRows& rows) const {
  const Vector3 leader_velocity = leaderVelocity(situation);
  const double margin = parameters_.margin + parameters_.speed_margin * leader_velocity.norm();
  for (int m = 0; m < features.size(); ++m) {
    Vector3 g = Vector3::Zero();  // of all commanded ones together
    double reach = 0.0;           // [m/s] that they can move the feature by
    for (const int agent : commanded_) {
      g += features.gradient(m, agent);
      reach += max_velocity_ * features.gradient(m, agent).lpNorm<1>();
    }
    const double h = value(predictedDistance(features, m, situation)) - margin;
    const double carried = features.normal[m].dot(leader_velocity - obstacleVelocity(features, m));
    const double share = formulation_.shares ? shareOf(features, m) : 1.0;
    const double loose = looseness(features.distance[m] - features.distance[0], parameters_.band);
    const auto add = [&](Tier tier, const PiecewiseLinearClassK& alpha) {
      const double bound = g.dot(leader_velocity) - share * (carried + alpha(h));
      auto row = rows.add(tier, bound - loose * std::max(0.0, bound + reach));  // every velocity satisfies -reach
      for (std::size_t i = 0; i < commanded_.size(); ++i) {
        row.segment<3>(3 * i) = features.gradient(m, commanded_[i]);
      }
    };
    add(Tier::COLLISION, parameters_.alpha);
    if (formulation_.anticipation) {
      add(Tier::ANTICIPATION, parameters_.anticipation);
    }
  }
}

Vector3 CollisionBarrier::leaderVelocity(const Situation& situation) const {
  return formulation_.leader_velocity ? situation.leaderVelocity() : Vector3::Zero();
}

Vector3 CollisionBarrier::obstacleVelocity(const Features& features, int feature) const {
  return formulation_.obstacle_velocity ? features.obstacle_velocity[feature] : Vector3::Zero();
}

//! Distance [m] when the command starts to act, to first order.
double CollisionBarrier::predictedDistance(const Features& features, int feature, const Situation& situation) const {
  const Vector3 leader_velocity = leaderVelocity(situation);
  double rate = features.normal[feature].dot(leader_velocity - obstacleVelocity(features, feature));
  for (const int assistant : assistants_) {
    rate += features.gradient(feature, assistant).dot(situation.velocities[assistant] - leader_velocity);
  }
  return features.distance[feature] + situation.delay * rate;
}

//! The part of a feature's demand that the commanded assistants take.
double CollisionBarrier::shareOf(const Features& features, int feature) const {
  return sumOfSquares(features, feature, commanded_) / sumOfSquares(features, feature, assistants_);
}

}  // namespace control
}  // namespace deformable_manipulation
