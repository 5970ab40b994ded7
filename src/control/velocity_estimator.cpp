#include "deformable_manipulation/control/velocity_estimator.h"

#include <algorithm>
#include <cmath>

namespace deformable_manipulation {
namespace control {

bool VelocityEstimator::update(double time, const Eigen::Ref<const Eigen::VectorXd>& position) {
  if (!std::isfinite(time) || !position.allFinite()) {
    return false;
  }
  if (known_ > 0 && (time < time_ - jump_back_ || position.size() != position_.size())) {
    reset();
  }
  if (known_ == 0) {
    velocity_.setZero(position.size());
    acceleration_.setZero(position.size());
  } else {
    if (time < time_ + min_interval_) {
      return false;
    }
    const double middle = 0.5 * (time + time_);
    const double interval = time - time_;
    if (known_ > 1) {
      acceleration_ = ((position - position_) / interval - velocity_) / (middle - velocity_time_);
    }
    velocity_ = (position - position_) / interval;
    velocity_time_ = middle;
  }
  time_ = time;
  position_ = position;
  known_ = std::min(known_ + 1, 3);
  return true;
}

Eigen::VectorXd VelocityEstimator::velocityAt(double time) const {
  return velocity_ + (time - velocity_time_) * acceleration_;
}

}  // namespace control
}  // namespace deformable_manipulation
