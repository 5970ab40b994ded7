#pragma once

#include <Eigen/Core>

namespace deformable_manipulation {
namespace control {

//! Positions and velocities from noisy, delayed measurements; predicts positions at constant velocity.
//!
//! It fits a line to all measurements by least squares, with weights that fall by 1 / e per time constant of age: a
//! filter of second order with fading memory (Morrison, Introduction to sequential smoothing and
//! prediction, 1969). With theta = exp(-dt / tau), each measurement corrects the prediction by its residual r:
//!
//!   position += (1 - theta^2) r,   velocity += (1 - theta)^2 r / dt.
//!
//! The first measurements have equal weights, so that a motion under way is followed at once: after n measurements,
//! the gains are at least 2 (2 n + 1) / ((n + 1) (n + 2)) and 6 / ((n + 1) (n + 2)).
//!
//! Motion of constant velocity is followed without lag; an acceleration a leaves the position a tau^2 behind and the
//! velocity 2 a tau. White noise s in the measurements leaves 1.1 s (dt / tau)^(1/2) in the position, and in the
//! velocity s / (2 dt) (dt / tau)^(3/2). A time constant of zero passes on the measurements and their differences.
//!
//! One filter serves all coordinates that share their stamps.
class PositionFilter {
 public:
  //! @param time_constant [s] >= 0. @throw std::invalid_argument
  explicit PositionFilter(double time_constant);

  //! Forgets all measurements.
  void reset() { known_ = 0; }

  //! Takes in positions [m] measured at a time [s].
  //! @return whether they were accepted: finite, and newer than all before
  bool update(double time, const Eigen::Ref<const Eigen::VectorXd>& position);

  bool hasPosition() const { return known_ > 0; }

  //! Positions [m] at a time, at constant velocity from the newest measurements on.
  Eigen::VectorXd position(double time) const { return position_ + (time - time_) * velocity_; }

  //! [m/s] at the time of the newest measurements.
  const Eigen::VectorXd& velocity() const { return velocity_; }

 private:
  double time_constant_;
  long known_ = 0;  // measurements since the start
  double time_ = 0.0;
  Eigen::VectorXd position_;
  Eigen::VectorXd velocity_;
};

}  // namespace control
}  // namespace deformable_manipulation
