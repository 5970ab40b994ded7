#include "deformable_manipulation/control/disturbance_observer.h"

#include <algorithm>
#include <cmath>

namespace deformable_manipulation {
namespace control {

namespace {

constexpr std::int64_t NOT_FOLLOWED = -1;

double modelledRate(const Features& features, int feature, const std::vector<Vector3>& velocities,
                    bool obstacle_velocity) {
  double rate = obstacle_velocity ? -features.normal[feature].dot(features.obstacle_velocity[feature]) : 0.0;
  for (int agent = 0; agent < features.agents(); ++agent) {
    rate += features.gradient(feature, agent).dot(velocities[agent]);
  }
  return rate;
}

}  // namespace

void DisturbanceObserver::setTimeConstant(double time_constant) { time_constant_ = time_constant; }

void DisturbanceObserver::reset() { last_.clear(); }

void DisturbanceObserver::update(double time, const std::vector<Vector3>& velocities, bool obstacle_velocity,
                                 Features& features) {
  if (time_constant_ == 0.0) {
    return;
  }
  const double elapsed = time - time_;
  const double taken = 1.0 - std::exp(-elapsed / time_constant_);
  now_.clear();
  for (int m = 0; m < features.size(); ++m) {
    const Followed* before = elapsed > 0.0 ? find(features.identity[m]) : nullptr;
    if (before != nullptr) {
      const double observed = (features.distance[m] - before->distance) / elapsed;
      const double surprise = observed - modelledRate(features, m, velocities, obstacle_velocity);
      features.disturbance[m] = before->rate + taken * (surprise - before->rate);
    }
    if (features.identity[m] != NOT_FOLLOWED) {
      now_.push_back({features.identity[m], features.distance[m], features.disturbance[m]});
    }
  }
  std::sort(now_.begin(), now_.end(), [](const Followed& a, const Followed& b) { return a.identity < b.identity; });
  last_.swap(now_);
  time_ = time;
}

const DisturbanceObserver::Followed* DisturbanceObserver::find(std::int64_t identity) const {
  const auto found =
      std::lower_bound(last_.begin(), last_.end(), identity,
                       [](const Followed& followed, std::int64_t sought) { return followed.identity < sought; });
  return found != last_.end() && found->identity == identity ? &*found : nullptr;
}

}  // namespace control
}  // namespace deformable_manipulation
