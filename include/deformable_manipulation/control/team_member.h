#pragma once

#include <optional>

#include "deformable_manipulation/control/detour.h"
#include "deformable_manipulation/control/motion_limits.h"
#include "deformable_manipulation/pbd/types.h"

namespace deformable_manipulation {
namespace control {

using pbd::Vector3;

//! How an assistant's held point moves, or how its grip turns: then in rad instead of m.
struct MemberMotion {
  Vector3 command = Vector3::Zero();       //!< [m/s] the last one, which acts until the next does
  Vector3 acceleration = Vector3::Zero();  //!< [m/s^2] from the command before to it
  Vector3 departure = Vector3::Zero();     //!< [m/s] of it from its goal, by the rows
  Vector3 goal = Vector3::Zero();          //!< [m/s] the velocity that the filter is to come near to
  Vector3 lower = Vector3::Zero();         //!< [m/s] that the limits of velocity and acceleration allow
  Vector3 upper = Vector3::Zero();         //!< [m/s]

  //! The next command on the fastest way to rest.
  Vector3 slowed(const MotionLimits& limits) const;

  //! Sets the velocities that the limits allow in the next cycle: if it is disabled, the one on its way to rest alone.
  void setBounds(const MotionLimits& limits, bool enabled);

  //! Takes a command, which acts from the next state on.
  //! @param cycle_time [s] since the command before
  void setCommand(const Vector3& next, double cycle_time);

  //! What the rows make of the nominal velocity lasts, what the bounds alone make of it does not.
  //! @param next the command that was decided
  //! @param kept part of a departure that is kept without rows that act
  void keepDeparture(const Vector3& next, bool rows_act, double kept);

  //! Forgets it.
  void stop();
};

//! An assistant in a controller's program, whoever commands it.
struct TeamMember : MemberMotion {
  int agent = -1;                       //!< index
  bool own = false;                     //!< false: another controller commands it
  bool enabled = true;                  //!< it follows the leader
  Vector3 reference = Vector3::Zero();  //!< [m] its place relative to the leader, before that turns
  Vector3 aim = Vector3::Zero();        //!< [m] where it goes, relative to the leader: its reference or a detour
  MemberMotion turn = {};               //!< of its grip
  std::optional<Detour> detour = {};    //!< if it may take one
  bool rows_act = false;                //!< the bounds alone would allow another velocity
};

}  // namespace control
}  // namespace deformable_manipulation
