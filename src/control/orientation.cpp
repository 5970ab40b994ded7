#include "deformable_manipulation/control/orientation.h"

#include <cmath>

namespace deformable_manipulation {
namespace control {
namespace {

constexpr double kTurn = 2.0 * M_PI;
constexpr double kSmall = 1e-9;  // of half an angle, below which its sine is the angle

}  // namespace

Vector3 rotationVector(const Quaternion& rotation) {
  const double sign = rotation.w() < 0.0 ? -1.0 : 1.0;
  const double sine = rotation.vec().norm();
  if (sine < kSmall) {
    return 2.0 * sign * rotation.vec();
  }
  return sign * 2.0 * std::atan2(sine, std::abs(rotation.w())) / sine * rotation.vec();
}

Quaternion rotationBy(const Vector3& vector) {
  const double half = 0.5 * vector.norm();
  const double scale = half < kSmall ? 0.5 : 0.5 * std::sin(half) / half;
  Quaternion rotation;
  rotation.w() = std::cos(half);
  rotation.vec() = scale * vector;
  return rotation.normalized();
}

Vector3 rotationVectorNear(const Quaternion& rotation, const Vector3& before) {
  const Vector3 shorter = rotationVector(rotation);
  if (shorter.norm() < kSmall) {
    return shorter;
  }
  const Vector3 longer = shorter - kTurn * shorter.normalized();
  return (longer - before).squaredNorm() < (shorter - before).squaredNorm() ? longer : shorter;
}

}  // namespace control
}  // namespace deformable_manipulation
