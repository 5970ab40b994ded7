#pragma once

#include <string>

#include <geometry_msgs/PoseStamped.h>
#include <ros/time.h>

#include "deformable_manipulation/pbd/types.h"

namespace deformable_manipulation {

//! The newest acceptable measured pose of one agent, for agents that are driven by their pose.
class PoseInbox {
 public:
  //! @param frame  fixed frame that poses must be in
  explicit PoseInbox(std::string frame) : frame_(std::move(frame)) {}

  //! @return why the pose is dropped; empty if it is accepted
  std::string receive(const geometry_msgs::PoseStamped& pose);

  //! Whether there is a pose not older than the timeout [s].
  bool fresh(const ros::Time& now, double timeout) const;

  //! The velocity that leads from a pose to the newest one in a time [s], at most kMaxSpeed: a
  //! measurement that leaps must not tear the object.
  pbd::Twist twistFrom(const pbd::Pose& present, double time) const;

  static constexpr double kMaxSpeed = 2.0;         // m/s
  static constexpr double kMaxAngularSpeed = 6.0;  // rad/s

 private:
  std::string frame_;
  bool received_ = false;
  ros::Time stamp_;
  pbd::Pose pose_;
};

}  // namespace deformable_manipulation
