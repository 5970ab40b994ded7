#pragma once

#include "deformable_manipulation/distance/features.h"

namespace deformable_manipulation {
namespace distance {

//! Where an obstacle is in the fixed frame, and how it moves.
class ObstacleFrame {
 public:
  void set(const Vector3& translation, const pbd::Quaternion& rotation, const pbd::Twist& velocity) {
    rotation_ = rotation.normalized().toRotationMatrix();
    translation_ = translation;
    velocity_ = velocity;
  }

  Vector3 toLocal(const Vector3& point) const { return rotation_.transpose() * (point - translation_); }
  Vector3 toFixed(const Vector3& direction) const { return rotation_ * direction; }

  //! Of the obstacle [m/s] at a point of the fixed frame.
  Vector3 velocityAt(const Vector3& point) const {
    return velocity_.linear + velocity_.angular.cross(point - translation_);
  }

 private:
  Eigen::Matrix3d rotation_ = Eigen::Matrix3d::Identity();
  Vector3 translation_ = Vector3::Zero();  // m
  pbd::Twist velocity_;
};

}  // namespace distance
}  // namespace deformable_manipulation
