#include "convex_shape.h"

#include <algorithm>
#include <cmath>

namespace deformable_manipulation {
namespace distance {
namespace {

constexpr double kLevel = 1e-12;  // components of a unit vector below it count as none

//! The end of an interval from -half to half that lies along a component of a unit vector.
double endAlong(double component, double half) {
  return std::fabs(component) > kLevel ? std::copysign(half, component) : 0.0;
}

//! The unit vector away from the z axis; on it, any.
Vector3 awayFromAxis(const Vector3& point, double away) {
  return away > 0.0 ? Vector3(point.x() / away, point.y() / away, 0.0) : Vector3(Vector3::UnitX());
}

}  // namespace

double HalfSpace::signedDistance(const Vector3& point, Vector3* gradient) const {
  *gradient = normal_;
  return normal_.dot(point);
}

Vector3 HalfSpace::support(const Vector3& /*direction*/) const { return Vector3::Zero(); }

double BoxShape::signedDistance(const Vector3& point, Vector3* gradient) const {
  const Vector3 beyond = point.cwiseAbs() - half_;
  const Vector3 outside = beyond.cwiseMax(0.0);
  const double distance = outside.norm();
  gradient->setZero();
  if (distance > 0.0) {
    for (int k = 0; k < 3; ++k) {
      (*gradient)[k] = std::copysign(outside[k] / distance, point[k]);
    }
    return distance;
  }
  int nearest = 0;
  const double depth = beyond.maxCoeff(&nearest);
  (*gradient)[nearest] = std::copysign(1.0, point[nearest]);
  return depth;
}

Vector3 BoxShape::support(const Vector3& direction) const {
  const Vector3 along = direction.normalized();
  return {endAlong(along.x(), half_.x()), endAlong(along.y(), half_.y()), endAlong(along.z(), half_.z())};
}

double CylinderShape::signedDistance(const Vector3& point, Vector3* gradient) const {
  const double away = std::hypot(point.x(), point.y());
  const double aside = away - radius_, above = std::fabs(point.z()) - half_;
  const Vector3 radial = awayFromAxis(point, away);
  const Vector3 upwards(0.0, 0.0, std::copysign(1.0, point.z()));
  if (aside > 0.0 && above > 0.0) {
    const double distance = std::hypot(aside, above);
    *gradient = (aside / distance) * radial + (above / distance) * upwards;
    return distance;
  }
  *gradient = aside > above ? radial : upwards;
  return std::max(aside, above);
}

Vector3 CylinderShape::support(const Vector3& direction) const {
  const Vector3 along = direction.normalized();
  const double away = std::hypot(along.x(), along.y());
  Vector3 farthest = Vector3::Zero();
  if (away > kLevel) {
    farthest = radius_ * awayFromAxis(along, away);
  }
  farthest.z() = endAlong(along.z(), half_);
  return farthest;
}

double CapsuleShape::signedDistance(const Vector3& point, Vector3* gradient) const {
  const Vector3 arm(point.x(), point.y(), point.z() - std::min(std::max(point.z(), -half_), half_));
  const double length = arm.norm();
  *gradient = length > 0.0 ? Vector3(arm / length) : Vector3(Vector3::UnitX());
  return length - radius_;
}

Vector3 CapsuleShape::support(const Vector3& direction) const {
  const Vector3 along = direction.normalized();
  return radius_ * along + Vector3(0.0, 0.0, endAlong(along.z(), half_));
}

}  // namespace distance
}  // namespace deformable_manipulation
