#include "deformable_manipulation/control/measured_obstacle.h"

#include <algorithm>
#include <cmath>

#include "deformable_manipulation/control/orientation.h"

namespace deformable_manipulation {
namespace control {
namespace {

constexpr double SMOOTHING = 0.1;  // [s] time constant of its velocity
constexpr double LONGEST = 0.5;    // [s] between poses of one motion
constexpr double FASTEST = 5.0;    // [m/s] faster is no motion but a leap
constexpr int STEPS = 32;          // of an extrapolated path: between two poses a turn is the shorter one

pbd::Quaternion turned(const Vector3& vector, const pbd::Quaternion& rotation) {
  const double angle = vector.norm();
  return angle > 0.0 ? pbd::Quaternion(Eigen::AngleAxisd(angle, vector / angle)) * rotation : rotation;
}

}  // namespace

void MeasuredObstacle::observe(double time, const Pose& pose) {
  const double passed = time - time_;
  const Vector3 way = pose.position - pose_.position;
  if (!seen_ || passed <= 0.0 || passed > LONGEST || way.norm() > FASTEST * passed) {
    velocity_ = {};
  } else {
    const double change = 1.0 - std::exp(-passed / SMOOTHING);
    const Vector3 turn = rotationVector(pose.orientation * pose_.orientation.conjugate());
    velocity_.linear += change * (way / passed - velocity_.linear);
    velocity_.angular += change * (turn / passed - velocity_.angular);
  }
  seen_ = true;
  time_ = time;
  pose_ = pose;
}

const std::vector<distance::Feature>& MeasuredObstacle::compute(const distance::ObjectView& object,
                                                                const std::vector<double>& times, double doubt) {
  const double last = times.empty() ? time_ : std::max(time_, *std::max_element(times.begin(), times.end()));
  PosePath path{time_, std::max(last - time_, 1e-3) / STEPS, {}};
  for (int k = 0; k <= STEPS; ++k) {
    const double ahead = k * path.step;
    path.poses.push_back(
        {pose_.position + ahead * velocity_.linear, turned(ahead * velocity_.angular, pose_.orientation)});
  }
  forecast_.setPath(std::move(path));
  features_ = forecast_.compute(object, times, time_);
  for (int copy = 0; copy < object.copies; ++copy) {
    distance::Feature& feature = features_[copy];
    const double ahead = std::max(0.0, times[copy] - time_);
    const Vector3 arm = feature.obstacle_point - (pose_.position + ahead * velocity_.linear);
    feature.distance -= doubt * ahead * (velocity_.linear + velocity_.angular.cross(arm)).norm();
  }
  return features_;
}

}  // namespace control
}  // namespace deformable_manipulation
