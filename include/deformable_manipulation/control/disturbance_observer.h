#pragma once

#include <cstdint>
#include <vector>

#include "deformable_manipulation/control/features.h"

namespace deformable_manipulation {
namespace control {

//! Disturbances: rates at which distances change that neither the gradients nor the obstacles' velocities explain.
//!
//! The gradients are those of an object at rest. An object moves differently if it swings, lags behind its equilibrium
//! or is made of another material than assumed, or if an obstacle of unknown velocity comes near. With the measured
//! distance d of a feature from state to state, the gradients g_a, the velocities v_a and the obstacle's velocity w,
//!
//!   e <- e + (1 - exp(-dt / tau)) (dd/dt - sum_a g_a . v_a + n . w - e) ,
//!
//! starting from zero for a new feature. Features are followed by their identities.
class DisturbanceObserver {
 public:
  //! @param time_constant tau [s]; 0: all rates are 0
  explicit DisturbanceObserver(double time_constant) : time_constant_(time_constant) {}

  void setTimeConstant(double time_constant);
  void reset();

  //! Updates the rates from the features of a state and stores them there (Features::disturbance).
  //! @param time [s] of the state, later than the last
  //! @param velocities [A] m/s, of the held points from the last state to this one
  //! @param obstacle_velocity whether the rows know the obstacles' velocities; else w counts as part of the disturbance
  void update(double time, const std::vector<Vector3>& velocities, bool obstacle_velocity, Features& features);

 private:
  struct Followed {
    std::int64_t identity;
    double distance;  // m
    double rate;      // m/s
  };

  const Followed* find(std::int64_t identity) const;

  double time_constant_;
  double time_ = 0.0;
  std::vector<Followed> last_;  // by identity
  std::vector<Followed> now_;
};

}  // namespace control
}  // namespace deformable_manipulation
