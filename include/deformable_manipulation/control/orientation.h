#pragma once

#include "deformable_manipulation/pbd/types.h"

namespace deformable_manipulation {
namespace control {

using pbd::Quaternion;
using pbd::Vector3;

//! [rad] The rotation vector of a rotation, up to half a turn long.
Vector3 rotationVector(const Quaternion& rotation);

//! The rotation by a rotation vector [rad].
Quaternion rotationBy(const Vector3& vector);

//! [rad] Of the two rotation vectors of a rotation within a turn, the one nearer to what it was: it does not jump where
//! the shorter way round changes.
Vector3 rotationVectorNear(const Quaternion& rotation, const Vector3& before);

}  // namespace control
}  // namespace deformable_manipulation
