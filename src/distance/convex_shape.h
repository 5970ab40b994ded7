#pragma once

#include "deformable_manipulation/distance/features.h"

namespace deformable_manipulation {
namespace distance {

//! A convex solid in a frame of its own. Its signed distance is a convex function of the point.
class ConvexShape {
 public:
  virtual ~ConvexShape() = default;

  //! @param gradient a unit vector along which the distance grows fastest; where there are several, one of them
  //! @return the signed distance [m] of a point, negative inside
  virtual double signedDistance(const Vector3& point, Vector3* gradient) const = 0;

  //! The middle of the points [m] that reach farthest along a direction, not zero; any point where none is farthest.
  virtual Vector3 support(const Vector3& direction) const = 0;
};

//! All points on and behind a plane through the origin.
class HalfSpace : public ConvexShape {
 public:
  explicit HalfSpace(const Vector3& normal) : normal_(normal.normalized()) {}

  double signedDistance(const Vector3& point, Vector3* gradient) const override;
  Vector3 support(const Vector3& direction) const override;

 private:
  Vector3 normal_;
};

//! A box around the origin, along the axes.
class BoxShape : public ConvexShape {
 public:
  explicit BoxShape(const Vector3& size) : half_(0.5 * size) {}

  double signedDistance(const Vector3& point, Vector3* gradient) const override;
  Vector3 support(const Vector3& direction) const override;

 private:
  Vector3 half_;  // m
};

//! A cylinder around the z axis, its middle at the origin.
class CylinderShape : public ConvexShape {
 public:
  CylinderShape(double radius, double length) : radius_(radius), half_(0.5 * length) {}

  double signedDistance(const Vector3& point, Vector3* gradient) const override;
  Vector3 support(const Vector3& direction) const override;

 private:
  double radius_, half_;  // m
};

//! All points near a piece of the z axis, whose middle is the origin; without a length, a sphere.
class CapsuleShape : public ConvexShape {
 public:
  CapsuleShape(double radius, double length) : radius_(radius), half_(0.5 * length) {}

  double signedDistance(const Vector3& point, Vector3* gradient) const override;
  Vector3 support(const Vector3& direction) const override;

 private:
  double radius_, half_;  // m
};

}  // namespace distance
}  // namespace deformable_manipulation
