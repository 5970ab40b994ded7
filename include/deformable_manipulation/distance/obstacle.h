#pragma once

#include <vector>

#include "deformable_manipulation/distance/features.h"

namespace deformable_manipulation {
namespace distance {

//! An obstacle. Distances are from the object's centre line or mid-surface; the signed
//! distance is the lowest signed distance of the object's points to the obstacle's surface, negative
//! inside.
//!
//! An obstacle may remember what was nearest to speed up the next call, but results depend only on
//! the arguments. One instance must not be used by several threads at a time.
class Obstacle {
 public:
  virtual ~Obstacle() = default;

  //! Moves the obstacle.
  //! @param translation [m] and rotation (of length 1): of the obstacle in the fixed frame
  //! @param velocity of the obstacle's origin [m/s] and about it [rad/s], in the fixed frame
  //! @throw std::invalid_argument All reasons
  void setPose(const Vector3& translation, const pbd::Quaternion& rotation, const pbd::Twist& velocity = {});

  //! The nearest pair of every copy.
  //! @param nearest [copies] filled but for `obstacle`
  virtual void minima(const ObjectView& object, Feature* nearest) = 0;

  //! Appends the nearest point of each segment or triangle of copy 0 whose signed distance is at most `limit` [m], in
  //! any order.
  virtual void features(const ObjectView& object, double limit, std::vector<Feature>* found) = 0;

 private:
  //! Takes a pose and a velocity that have been checked.
  virtual void place(const Vector3& translation, const pbd::Quaternion& rotation, const pbd::Twist& velocity) = 0;
};

}  // namespace distance
}  // namespace deformable_manipulation
