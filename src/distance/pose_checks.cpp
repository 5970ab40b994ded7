#include "pose_checks.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace deformable_manipulation {
namespace distance {
namespace {

constexpr double kUnitTolerance = 1e-6;  // of a quaternion's length

void checkVector(const char* name, const char* unit, const pbd::Vector3& vector, std::vector<std::string>* problems) {
  if (!vector.allFinite()) {
    std::ostringstream text;
    text << name << " is " << vector.transpose() << "; it must be three finite numbers of " << unit;
    problems->push_back(text.str());
  }
}

}  // namespace

void checkPose(const pbd::Vector3& translation, const pbd::Quaternion& rotation, std::vector<std::string>* problems) {
  checkVector("translation", "metres", translation, problems);
  if (!(std::fabs(rotation.norm() - 1.0) <= kUnitTolerance)) {
    std::ostringstream text;
    text << "rotation is " << rotation.coeffs().transpose() << "; it must be a quaternion x, y, z, w of length 1";
    problems->push_back(text.str());
  }
}

void checkTwist(const pbd::Twist& velocity, std::vector<std::string>* problems) {
  checkVector("linear velocity", "m/s", velocity.linear, problems);
  checkVector("angular velocity", "rad/s", velocity.angular, problems);
}

void throwIfAny(const std::vector<std::string>& problems) {
  std::string text;
  for (const std::string& problem : problems) {
    text += (text.empty() ? "" : "\n") + problem;
  }
  if (!text.empty()) {
    throw std::invalid_argument(text);
  }
}

}  // namespace distance
}  // namespace deformable_manipulation
