#include "command_inbox.h"

#include <sstream>

namespace deformable_manipulation {
namespace {

pbd::Vector3 toVector(const geometry_msgs::Vector3& vector) { return {vector.x, vector.y, vector.z}; }

}  // namespace

std::string CommandInbox::receive(const geometry_msgs::TwistStamped& command, const ros::Time& newest_state) {
  std::ostringstream why;
  const pbd::Twist twist{toVector(command.twist.linear), toVector(command.twist.angular)};
  if (command.header.frame_id != frame_) {
    why << "it is in frame '" << command.header.frame_id << "', not in '" << frame_ << "'";
  } else if (!twist.linear.allFinite() || !twist.angular.allFinite()) {
    why << "it is not finite";
  } else if (command.header.stamp > newest_state) {
    why << "its stamp " << command.header.stamp << " is newer than any state; set it to the stamp of the state answered";
  } else if (received_ && command.header.stamp <= stamp_) {
    why << "its stamp " << command.header.stamp << " is not newer than the last one, " << stamp_;
  } else {
    received_ = true;
    stamp_ = command.header.stamp;
    twist_ = twist;
  }
  return why.str();
}

pbd::Twist CommandInbox::command(const ros::Time& now, double timeout) const {
  return timedOut(now, timeout) ? pbd::Twist() : command();
}

bool CommandInbox::timedOut(const ros::Time& now, double timeout) const {
  return received_ && (now - stamp_).toSec() > timeout;
}

}  // namespace deformable_manipulation
