#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <ros/ros.h>

#include <map>
#include <string>
#include <vector>

#include "command_inbox.h"
#include "deformable_manipulation/pbd/types.h"
#include "pose_inbox.h"

namespace deformable_manipulation {

//! What moves an agent of the simulation.
enum class DrivenBy {
  COMMAND,  //!< its cmd_vel; the simulator publishes its pose
  POSE      //!< its pose topic: a real robot, or another simulator
};

//! An agent's topics: commands or measured poses in, poses and wrenches out.
class AgentLink {
 public:
  //! @param pose_namespace  prefix of the pose topic of an agent driven by its pose
  //! @param timeout         [s] age at which commands and poses count as lost
  //! @param pose_smoothing  [s] time constant of the filter of measured poses
  //! @param lockstep        commands answer the newest state and do not age
  AgentLink(ros::NodeHandle& node, const std::string& name, DrivenBy driven_by, const std::string& frame,
            const std::string& pose_namespace, double timeout, double pose_smoothing, bool lockstep);

  //! Publishes pose and wrench to whoever subscribes.
  void publish(const pbd::Pose& pose, const pbd::Wrench& wrench, const ros::Time& stamp);

  //! Whether the agent has answered this state; agents driven by their pose need not.
  bool answers(const ros::Time& state) const;

  //! The velocity of the agent in the next cycle: zero, with a warning, where its input is missing.
  pbd::Twist twist(const pbd::Pose& present, double cycle_time) const;

  //! Whether the simulated agent is where the real one is: driven by commands, or close to a pose
  //! that is not lost. Says why not.
  bool isTrue(const pbd::Pose& present) const;

  //! What is awaited of an agent that is not true.
  std::string awaited() const;

  //! A clause that says why the agent's input is not used at present; empty if it is.
  std::string fault() const;

  bool followsPoses() const { return driven_by_ == DrivenBy::POSE; }

  //! Velocity [m/s] of the agent: measured and filtered, or that of its simulated motion.
  pbd::Vector3 velocity(const pbd::Twist& simulated) const {
    return followsPoses() ? poses_.velocity() : simulated.linear;
  }

  //! Forgets what has been received.
  void reset();

  const std::string& name() const { return name_; }

 private:
  void receiveCommand(const ros::MessageEvent<geometry_msgs::TwistStamped const>& event);
  void receivePose(const geometry_msgs::PoseStamped::ConstPtr& pose);
  void warn(const std::string& text) const;
  pbd::Twist commanded() const;
  std::vector<std::string> presentSenders() const;

  std::string name_;
  DrivenBy driven_by_;
  std::string frame_;
  double timeout_;  // s
  bool lockstep_;
  CommandInbox commands_;
  PoseInbox poses_;
  ros::Time newest_state_;
  std::map<std::string, ros::SteadyTime> senders_;              // of commands, and when they were heard last
  mutable std::map<std::string, ros::SteadyTime> quiet_until_;  // for each warning, numbers apart
  ros::Publisher pose_publisher_, wrench_publisher_;
  ros::Subscriber subscriber_;
};

}  // namespace deformable_manipulation
