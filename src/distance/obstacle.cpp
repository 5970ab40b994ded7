#include "deformable_manipulation/distance/obstacle.h"

#include <string>

#include "pose_checks.h"

namespace deformable_manipulation {
namespace distance {

void Obstacle::setPose(const Vector3& translation, const pbd::Quaternion& rotation, const pbd::Twist& velocity) {
  std::vector<std::string> problems;
  checkPose(translation, rotation, &problems);
  checkTwist(velocity, &problems);
  throwIfAny(problems);
  place(translation, rotation, velocity);
}

}  // namespace distance
}  // namespace deformable_manipulation
