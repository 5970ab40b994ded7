#pragma once

#include <memory>
#include <vector>

#include "deformable_manipulation/control/obstacle_forecast.h"

namespace deformable_manipulation {
namespace control {

//! An obstacle whose poses are measured: over the horizon it goes on with its present velocity, with growing doubt.
class MeasuredObstacle {
 public:
  //! @param forecast its path is of no account
  //! @param index of its pose among those of an observation
  MeasuredObstacle(ObstacleForecast forecast, int index) : forecast_(std::move(forecast)), index_(index) {}

  int index() const { return index_; }

  //! Takes in where it is at a time [s].
  void observe(double time, const Pose& pose);

  //! Forgets how it has moved.
  void reset() { seen_ = false; }

  //! As ObstacleForecast does. Distances are smaller by a part of the way that its nearest point would go until then.
  //! @param doubt that part
  const std::vector<distance::Feature>& compute(const distance::ObjectView& object, const std::vector<double>& times,
                                                double doubt);

 private:
  ObstacleForecast forecast_;
  int index_;
  bool seen_ = false;
  double time_ = 0.0;  // [s] of the newest pose
  Pose pose_;
  pbd::Twist velocity_;
  std::vector<distance::Feature> features_;
};

}  // namespace control
}  // namespace deformable_manipulation
