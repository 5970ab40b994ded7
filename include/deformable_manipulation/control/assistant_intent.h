#pragma once

#include "deformable_manipulation/pbd/types.h"

namespace deformable_manipulation {
namespace control {

using pbd::Vector3;

//! What an assistant tells those who plan with it: how it goes on from the state that it has answered last.
struct AssistantIntent {
  double time;           //!< [s] of that state
  bool follows;          //!< false: it stands still, or slows down to it
  bool hears;            //!< it hears all others, who do what it expects of them
  bool coordinated;      //!< the command was decided together; false: by shares
  Vector3 reference;     //!< [m] its place relative to the leader
  Vector3 command;       //!< [m/s] that answers the state
  Vector3 acceleration;  //!< [m/s^2] from the command before to it
  Vector3 departure;     //!< [m/s] of the command from its goal, by the limits

  //! The same three of its grip's turning [rad/s, rad/s^2, rad/s].
  Vector3 angular_command = Vector3::Zero();
  Vector3 angular_acceleration = Vector3::Zero();
  Vector3 angular_departure = Vector3::Zero();
};

}  // namespace control
}  // namespace deformable_manipulation
