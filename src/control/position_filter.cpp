#include "deformable_manipulation/control/position_filter.h"

#include <cmath>
#include <stdexcept>

namespace deformable_manipulation {
namespace control {

PositionFilter::PositionFilter(double time_constant) : time_constant_(time_constant) {
  if (!(time_constant >= 0.0) || !std::isfinite(time_constant)) {
    throw std::invalid_argument("the time constant of a filter is " + std::to_string(time_constant) +
                                " s, it must be >= 0");
  }
}

bool PositionFilter::update(double time, const Eigen::Ref<const Eigen::VectorXd>& position) {
  if (!std::isfinite(time) || !position.allFinite()) {
    return false;
  }
  if (!known_ || position.size() != position_.size()) {
    position_ = position;
    velocity_.setZero(position.size());
  } else if (time <= time_) {
    return false;
  } else {
    const double interval = time - time_;
    const double theta = time_constant_ > 0.0 ? std::exp(-interval / time_constant_) : 0.0;
    position_ += interval * velocity_;
    velocity_ += (1.0 - theta) * (1.0 - theta) / interval * (position - position_);
    position_ += (1.0 - theta * theta) * (position - position_);
  }
  time_ = time;
  known_ = true;
  return true;
}

}  // namespace control
}  // namespace deformable_manipulation
