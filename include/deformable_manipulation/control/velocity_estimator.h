#pragma once

#include <Eigen/Core>

namespace deformable_manipulation {
namespace control {

//! Velocities from stamped positions: backward difference over the newest ones.
//!
//! The difference of the positions at t - dt and t is the mean velocity of that interval, that is the
//! velocity at t - dt / 2. The command computed from it acts from t + dt to t + 2 dt, around t + 3 dt / 2:
//! two cycles later. For an agent that accelerates by a, the estimate is 2 a dt behind by then (2 mm/s for
//! 0.1 m/s^2 at 100 Hz). Extrapolating would correct that but quadruple the effect of noise in the positions.
//!
//! One estimator serves all coordinates of all agents that share their stamps.
class VelocityEstimator {
 public:
  //! @param min_interval [s] stamps closer together count as the same: differences over shorter intervals amplify
  //! noise without bound
  //! @param jump_back [s] if a stamp is older than the newest by more than this, time was set back and the estimate
  //! starts again; a stamp that is less old came out of order and is ignored
  explicit VelocityEstimator(double min_interval = 1e-4, double jump_back = 0.2)
      : min_interval_(min_interval), jump_back_(jump_back) {}

  //! Forgets all positions.
  void reset() { known_ = 0; }

  //! Takes in a position [m] stamped with a time [s].
  //! @return whether it was accepted: finite, and newer than all before or after a jump back
  bool update(double time, const Eigen::Ref<const Eigen::VectorXd>& position);

  bool hasPosition() const { return known_ > 0; }

  //! Mean velocity [m/s] of the newest interval; zeros while fewer than two positions are known.
  const Eigen::VectorXd& velocity() const { return velocity_; }

 private:
  double min_interval_;
  double jump_back_;
  int known_ = 0;  // positions, up to 2, which give a velocity
  double time_ = 0.0;
  Eigen::VectorXd position_;
  Eigen::VectorXd velocity_;
};

}  // namespace control
}  // namespace deformable_manipulation
