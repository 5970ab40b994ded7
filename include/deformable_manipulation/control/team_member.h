#pragma once

#include <optional>

#include "deformable_manipulation/control/detour.h"
#include "deformable_manipulation/control/motion_limits.h"
#include "deformable_manipulation/pbd/types.h"

namespace deformable_manipulation {
namespace control {

using pbd::Vector3;

//! An assistant in a controller's program, whoever commands it.
struct TeamMember {
  int agent = -1;                          //!< index
  bool own = false;                        //!< false: another controller commands it
  bool enabled = true;                     //!< it follows the leader
  Vector3 reference = Vector3::Zero();     //!< [m] its place relative to the leader
  Vector3 command = Vector3::Zero();       //!< [m/s] the last one, which acts until the next does
  Vector3 acceleration = Vector3::Zero();  //!< [m/s^2] from the command before to it
  Vector3 departure = Vector3::Zero();     //!< [m/s] of it from its goal, by the rows
  Vector3 goal = Vector3::Zero();          //!< [m/s] the velocity that the filter is to come near to
  Vector3 lower = Vector3::Zero();         //!< [m/s] that the limits of velocity and acceleration allow
  Vector3 upper = Vector3::Zero();         //!< [m/s]
  Vector3 aim = Vector3::Zero();           //!< [m] where it goes, relative to the leader: its reference or a detour
  std::optional<Detour> detour = {};       //!< if it may take one
  bool rows_act = false;                   //!< the bounds alone would allow another velocity

  //! The next command on the fastest way to rest.
  Vector3 slowed(const MotionLimits& limits) const;

  //! Sets the velocities that the limits allow in the next cycle: if it is disabled, the one on its way to rest alone.
  void setBounds(const MotionLimits& limits);

  //! Takes a command, which acts from the next state on.
  //! @param cycle_time [s] since the command before
  void setCommand(const Vector3& next, double cycle_time);

  //! Forgets its motion.
  void stop();
};

}  // namespace control
}  // namespace deformable_manipulation
