#include "command_inbox.h"

#include <sstream>

namespace deformable_manipulation {
namespace {

pbd::Vector3 toVector(const geometry_msgs::Vector3& vector) { return {vector.x, vector.y, vector.z}; }

bool isStop(const pbd::Twist& twist) { return twist.linear.isZero(0.0) && twist.angular.isZero(0.0); }

}  // namespace

std::string CommandInbox::receive(const geometry_msgs::TwistStamped& command, const ros::Time& latest) {
  std::ostringstream why;
  const pbd::Twist twist{toVector(command.twist.linear), toVector(command.twist.angular)};
  if (command.header.frame_id != frame_) {
    why << "it is in frame '" << command.header.frame_id << "', not in '" << frame_ << "'";
  } else if (!twist.linear.allFinite() || !twist.angular.allFinite()) {
    why << "it is not finite";
  } else if (twist.linear.norm() > kLargestSpeed || twist.angular.norm() > kLargestAngularSpeed) {
    why << "it asks for " << twist.linear.norm() << " m/s and " << twist.angular.norm() << " rad/s; the limits are "
        << kLargestSpeed << " and " << kLargestAngularSpeed;
  } else if (command.header.stamp > latest) {
    why << "its stamp " << command.header.stamp
        << " is in the future; set it to that of the state answered, and synchronise the computers' clocks";
  } else if (received_ && (command.header.stamp < stamp_ || (command.header.stamp == stamp_ && !isStop(twist)))) {
    why << "its stamp " << command.header.stamp << " is not newer than the last one, " << stamp_;
  } else {
    received_ = true;
    received_at_ = ros::SteadyTime::now();
    stamp_ = command.header.stamp;
    twist_ = twist;
  }
  return why.str();
}

pbd::Twist CommandInbox::command(const ros::Time& now, double timeout) const {
  return timedOut(now, timeout) ? pbd::Twist() : command();
}

bool CommandInbox::timedOut(const ros::Time& now, double timeout) const {
  return received_ && ((now - stamp_).toSec() > timeout || (ros::SteadyTime::now() - received_at_).toSec() > timeout);
}

}  // namespace deformable_manipulation
