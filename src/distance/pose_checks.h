#pragma once

#include <string>
#include <vector>

#include "deformable_manipulation/pbd/types.h"

namespace deformable_manipulation {
namespace distance {

//! Append what is wrong with the pose or the velocity of an obstacle.
void checkPose(const pbd::Vector3& translation, const pbd::Quaternion& rotation, std::vector<std::string>* problems);
void checkTwist(const pbd::Twist& velocity, std::vector<std::string>* problems);

//! @throw std::invalid_argument with all problems, one a line, if there are any
void throwIfAny(const std::vector<std::string>& problems);

}  // namespace distance
}  // namespace deformable_manipulation
