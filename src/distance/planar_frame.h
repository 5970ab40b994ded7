#pragma once

#include <Eigen/Geometry>
#include <array>

#include "deformable_manipulation/distance/features.h"
#include "planar_geometry.h"

namespace deformable_manipulation {
namespace distance {

//! Coordinates in the plane of an obstacle, counted from the middle of its boundary.
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

  Point2 project(const Vector3& point) const {
    Point2 flat;
    project(point.data(), 1, &flat);
    return flat;
  }

  //! Points [count x 3] to points of the plane [count].
  void project(const double* points, int count, Point2* flat) const {
    const double ux = u_.x(), uy = u_.y(), uz = u_.z(), vx = v_.x(), vy = v_.y(), vz = v_.z();
    const Point2 offset = offset_;
    for (int i = 0; i < count; ++i) {
      const double x = points[3 * i], y = points[3 * i + 1], z = points[3 * i + 2];
      flat[i] = {ux * x + uy * y + uz * z + offset.u, vx * x + vy * y + vz * z + offset.v};
    }
  }

  //! A vector in the plane as one of the fixed frame.
  Vector3 lift(const Point2& vector) const { return vector.u * u_ + vector.v * v_; }

 private:
  std::array<int, 2> axes_;
  Point2 origin_, offset_;
  Vector3 u_, v_;
};

}  // namespace distance
}  // namespace deformable_manipulation
