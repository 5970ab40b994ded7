#include "pose_inbox.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace deformable_manipulation {
namespace {

constexpr double kUnitTolerance = 1e-3;

// A pose this far from where it was expected is no noise: the filter starts afresh.
constexpr double kLeap = 0.05;  // m

pbd::Vector3 limited(const pbd::Vector3& vector, double largest) {
  const double size = vector.norm();
  return size > largest ? pbd::Vector3(vector * (largest / size)) : vector;
}

}  // namespace

std::string PoseInbox::receive(const geometry_msgs::PoseStamped& message) {
  std::ostringstream why;
  const geometry_msgs::Point& p = message.pose.position;
  const geometry_msgs::Quaternion& q = message.pose.orientation;
  pbd::Pose pose{pbd::Vector3(p.x, p.y, p.z), pbd::Quaternion(q.w, q.x, q.y, q.z)};
  if (message.header.frame_id != frame_) {
    why << "it is in frame '" << message.header.frame_id << "', not in '" << frame_ << "'";
  } else if (!pose.position.allFinite() || !pose.orientation.coeffs().allFinite()) {
    why << "it is not finite";
  } else if (std::abs(pose.orientation.norm() - 1.0) > kUnitTolerance) {
    why << "its quaternion has the norm " << pose.orientation.norm() << ", not 1";
  } else if (!silent() && message.header.stamp <= stamp_) {
    why << "its stamp " << message.header.stamp << " is not newer than the last one, " << stamp_;
  } else {
    if (silent()) {
      filter_.reset();
      origin_ = message.header.stamp;
    }
    received_ = true;
    received_at_ = ros::SteadyTime::now();
    stamp_ = message.header.stamp;
    pose.orientation.normalize();
    pose_ = pose;
    filter(pose.position);
  }
  return why.str();
}

void PoseInbox::filter(const pbd::Vector3& position) {
  const double time = (stamp_ - origin_).toSec();
  if (filter_.hasPosition() && (filter_.position(time) - position).norm() > kLeap) {
    filter_.reset();
  }
  filter_.update(time, position);
}

bool PoseInbox::silent() const { return !received_ || (ros::SteadyTime::now() - received_at_).toSec() > timeout_; }

bool PoseInbox::fresh(const ros::Time& now) const { return !silent() && std::abs((now - stamp_).toSec()) <= timeout_; }

pbd::Twist PoseInbox::twistFrom(const pbd::Pose& present, const ros::Time& now, double time) const {
  const double age = std::clamp((now - stamp_).toSec(), 0.0, timeout_);
  const pbd::Vector3 target = filter_.position((stamp_ - origin_).toSec() + age + time);
  const Eigen::AngleAxisd rotation(pose_.orientation * present.orientation.conjugate());
  const double angle = std::remainder(rotation.angle(), 2.0 * M_PI);  // the shorter way
  return {limited((target - present.position) / time, kMaxSpeed),
          limited(angle / time * rotation.axis(), kMaxAngularSpeed)};
}

}  // namespace deformable_manipulation
