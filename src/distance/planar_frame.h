#pragma once

#include <Eigen/Geometry>
#include <array>

#include "deformable_manipulation/distance/features.h"
#include "planar_geometry.h"

namespace deformable_manipulation {
namespace distance {

//! Coordinates in the plane of an obstacle, counted from the middle of its ring.
class PlanarFrame {
 public:
  //! @param axes which of the obstacle's own axes u and v are: 0 to 2
  //! @param origin [m] of the coordinates, in the obstacle's own
  PlanarFrame(const std::array<int, 2>& axes, const Point2& origin) : axes_(axes), origin_(origin) {
    setPose(Vector3::Zero(), pbd::Quaternion::Identity());
  }

  //! @param rotation of length 1
  void setPose(const Vector3& translation, const pbd::Quaternion& rotation) {
    u_ = rotation.normalized() * Vector3::Unit(axes_[0]);
    v_ = rotation.normalized() * Vector3::Unit(axes_[1]);
    offset_ = {-u_.dot(translation) - origin_.u, -v_.dot(translation) - origin_.v};
  }

  Point2 project(const Vector3& point) const { return {u_.dot(point) + offset_.u, v_.dot(point) + offset_.v}; }

  //! A vector in the plane as one of the fixed frame.
  Vector3 lift(const Point2& vector) const { return vector.u * u_ + vector.v * v_; }

 private:
  std::array<int, 2> axes_;
  Point2 origin_, offset_;
  Vector3 u_, v_;
};

}  // namespace distance
}  // namespace deformable_manipulation
