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
  } else if (time < time_ + min_interval_) {
    return false;
  } else {
    velocity_ = (position - position_) / (time - time_);
  }
  time_ = time;
  position_ = position;
  known_ = std::min(known_ + 1, 2);
  return true;
}

}  // namespace control
}  // namespace deformable_manipulation
