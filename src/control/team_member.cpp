#include "deformable_manipulation/control/team_member.h"

namespace deformable_manipulation {
namespace control {

Vector3 TeamMember::slowed(const MotionLimits& limits) const {
  Vector3 next;
  for (int axis = 0; axis < 3; ++axis) {
    next[axis] = limits.slowed(command[axis], acceleration[axis]);
  }
  return next;
}

void TeamMember::setBounds(const MotionLimits& limits) {
  if (!enabled) {
    lower = upper = slowed(limits);
    return;
  }
  for (int axis = 0; axis < 3; ++axis) {
    const VelocityRange range = limits.next(command[axis], acceleration[axis]);
    lower[axis] = range.lower;
    upper[axis] = range.upper;
  }
}

void TeamMember::setCommand(const Vector3& next, double cycle_time) {
  acceleration = (next - command) / cycle_time;
  command = next;
}

void TeamMember::stop() {
  command.setZero();
  acceleration.setZero();
  departure.setZero();
}

}  // namespace control
}  // namespace deformable_manipulation
