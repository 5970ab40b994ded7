#pragma once

namespace deformable_manipulation {
namespace control {

//! Outcome of one cycle; the numbers are those of ControllerState.msg.
enum class Status {
  NOMINAL,      //!< no constraint changes the nominal velocity
  CONSTRAINED,  //!< deviates from it so that all limits hold
  RELAXED,      //!< not all limits can hold
  FAILED,       //!< no valid solution: zero velocity
  WAITING,      //!< no valid input: zero velocity
  DISABLED,     //!< switched off: zero velocity
  UNSAFE_FILTER_OFF
};

}  // namespace control
}  // namespace deformable_manipulation
