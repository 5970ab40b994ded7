#include "deformable_manipulation/control/position_filter.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace deformable_manipulation {
namespace control {

PositionFilter::PositionFilter(double time_constant) : time_constant_(time_constant) {
  if (!(time_constant >= 0.0) || !std::isfinite(time_constant)) {
    throw std::invalid_argument("the time constant of a filter is " + std::to_string(time_constant) +
                                " s; it must be >= 0");
  }
}

bool PositionFilter::update(double time, const Eigen::Ref<const Eigen::VectorXd>& position) {
  if (!std::isfinite(time) || !position.allFinite()) {
    return false;
  }
  if (known_ == 0 || position.size() != position_.size()) {
    position_ = position;
    velocity_.setZero(position.size());
    known_ = 0;
  } else if (time <= time_) {
    return false;
  } else {
    const double interval = time - time_;
    const double theta = time_constant_ > 0.0 ? std::exp(-interval / time_constant_) : 0.0;
    const double n = static_cast<double>(known_);
    const double first = 1.0 / ((n + 1.0) * (n + 2.0));
    position_ += interval * velocity_;
    velocity_ += std::max((1.0 - theta) * (1.0 - theta), 6.0 * first) / interval * (position - position_);
    position_ += std::max(1.0 - theta * theta, (4.0 * n + 2.0) * first) * (position - position_);
  }
  time_ = time;
  ++known_;
  return true;
}

}  // namespace control
}  // namespace deformable_manipulation
