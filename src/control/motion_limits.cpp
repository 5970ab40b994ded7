#include "deformable_manipulation/control/motion_limits.h"

#include <algorithm>
#include <cmath>

namespace deformable_manipulation {
namespace control {

//! The most [m/s^2] with which a velocity may change that has so much room [m/s] left to its limit. With the jerk j,
//! cycles of h and the room r, what follows an acceleration a adds up to at most a^2 / (2 j), so a h + a^2 / (2 j) <=
//! r.
double MotionLimits::largestAcceleration(double room) const {
  if (std::isinf(max_jerk)) {
    return max_acceleration;
  }
  const double in_one_cycle = max_jerk * cycle_time;  // that much can be taken back at once
  const double in_several =
      std::sqrt(in_one_cycle * in_one_cycle + 2.0 * max_jerk * std::max(0.0, room)) - in_one_cycle;
  return std::min(max_acceleration, std::max(in_one_cycle, in_several));
}

VelocityRange MotionLimits::next(double velocity, double acceleration) const {
  const double change = max_jerk * cycle_time;
  const double least = std::max(-largestAcceleration(max_velocity + velocity), acceleration - change);
  const double most = std::min(largestAcceleration(max_velocity - velocity), acceleration + change);
  const double lower = std::max(velocity + least * cycle_time, -max_velocity);
  const double upper = std::min(velocity + most * cycle_time, max_velocity);
  if (lower <= upper) {
    return {lower, upper};
  }
  // Limits that were just lowered are exceeded already: the shortest way back.
  return velocity > 0.0 ? VelocityRange{lower, lower} : VelocityRange{upper, upper};
}

double MotionLimits::slowed(double velocity, double acceleration) const {
  const double braking = largestAcceleration(std::abs(velocity)) * cycle_time;
  const double wanted = velocity - std::clamp(velocity, -braking, braking);
  const VelocityRange range = next(velocity, acceleration);
  return std::clamp(wanted, range.lower, range.upper);
}

}  // namespace control
}  // namespace deformable_manipulation
