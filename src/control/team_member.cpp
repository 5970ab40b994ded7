#include "deformable_manipulation/control/team_member.h"

namespace deformable_manipulation {
namespace control {

Vector3 MemberMotion::slowed(const MotionLimits& limits) const {
  Vector3 next;
  for (int axis = 0; axis < 3; ++axis) {
    next[axis] = limits.slowed(command[axis], acceleration[axis]);
  }
  return next;
}

void MemberMotion::setBounds(const MotionLimits& limits, bool enabled) {
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

void MemberMotion::setCommand(const Vector3& next, double cycle_time) {
  acceleration = (next - command) / cycle_time;
  command = next;
}

void MemberMotion::keepDeparture(const Vector3& next, bool rows_act, double kept) {
  if (rows_act) {
    departure = next - goal;
  } else {
    departure *= kept;
  }
}

void MemberMotion::stop() {
  command.setZero();
  acceleration.setZero();
  departure.setZero();
}

}  // namespace control
}  // namespace deformable_manipulation
