#pragma once

#include <geometry_msgs/TwistStamped.h>
#include <ros/time.h>

#include <string>

#include "deformable_manipulation/pbd/types.h"

namespace deformable_manipulation {

//! The newest acceptable velocity command of one agent.
//!
//! A command answers the state whose stamp it carries. One that is not finite, faster than any agent
//! moves, in another frame, or does not answer a state newer than the last accepted one is dropped. A second answer to
//! the same state is taken if it is to stand still: who leaves or loses its inputs stops at once.
class CommandInbox {
 public:
  static constexpr double kLargestSpeed = 10.0;         // m/s
  static constexpr double kLargestAngularSpeed = 60.0;  // rad/s

  //! @param frame  fixed frame that commands must be in
  explicit CommandInbox(std::string frame) : frame_(std::move(frame)) {}

  //! @param latest  latest stamp that a command can have
  //! @return why the command is dropped; empty if it is accepted
  std::string receive(const geometry_msgs::TwistStamped& command, const ros::Time& latest);

  //! Whether the newest accepted command answers this state.
  bool answers(const ros::Time& state) const { return received_ && stamp_ == state; }

  //! The newest command, or rest if there is none, or it or the state that it answers is older than
  //! the timeout [s]. Its own age counts by the steady clock: the ROS clock may stand still.
  pbd::Twist command(const ros::Time& now, double timeout) const;

  //! Whether command() is at rest because commands stopped coming.
  bool timedOut(const ros::Time& now, double timeout) const;

  //! The newest command whatever its age, or rest if there is none.
  pbd::Twist command() const { return received_ ? twist_ : pbd::Twist(); }

  //! Whether a command has been accepted.
  bool known() const { return received_; }

  //! Forgets all commands.
  void reset() { received_ = false; }

 private:
  std::string frame_;
  bool received_ = false;
  ros::Time stamp_;
  ros::SteadyTime received_at_;
  pbd::Twist twist_;
};

}  // namespace deformable_manipulation
