#pragma once

#include <vector>

#include "deformable_manipulation/control/object_shape.h"

namespace deformable_manipulation {
namespace control {

//! Motion of the A agents, predicted for the time at which the command acts.
//!
//! The command computed from state k acts from state k + 1 on, or later if the answer is late. Until then, for `delay`
//! seconds, the commanded agent moves with its previous command and the others with their measured velocities.
struct PredictedState {
  std::vector<Vector3> positions;                //!< [A] m, held points when the command begins to act
  std::vector<Vector3> velocities;               //!< [A] m/s, from state k to then; expected to last
  std::vector<Vector3> angular_velocities = {};  //!< [A] rad/s, likewise; empty: grips do not turn
  int leader = 0;
  double delay = 0.0;      //!< [s] from state k to then
  ObjectShape shape = {};  //!< of the object in state k

  const Vector3& leaderVelocity() const { return velocities[leader]; }
};

}  // namespace control
}  // namespace deformable_manipulation
