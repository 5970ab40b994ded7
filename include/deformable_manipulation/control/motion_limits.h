#pragma once

namespace deformable_manipulation {
namespace control {

//! A range of velocities [m/s].
struct VelocityRange {
  double lower;
  double upper;
};

//! What a robot can do along an axis, from one velocity command to the next.
struct MotionLimits {
  double max_velocity;      //!< [m/s]
  double max_acceleration;  //!< [m/s^2]; infinite: steps are allowed
  double max_jerk;          //!< [m/s^3]; infinite: none
  double cycle_time;        //!< [s] between commands

  //! The commands that may come next. The acceleration of each can be taken back, at max_jerk, before the velocity
  //! exceeds its limit.
  //! @param velocity [m/s] of the last command
  //! @param acceleration [m/s^2] from the command before to the last
  VelocityRange next(double velocity, double acceleration) const;

  //! The next command on the fastest way to rest.
  double slowed(double velocity, double acceleration) const;

 private:
  double largestAcceleration(double room) const;
};

}  // namespace control
}  // namespace deformable_manipulation
