#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <ros/time.h>

#include <string>

#include "deformable_manipulation/control/position_filter.h"
#include "deformable_manipulation/pbd/types.h"

namespace deformable_manipulation {

//! The newest acceptable measured pose of one agent, for agents that are driven by their pose.
//!
//! A pose that is not finite, in another frame, or not newer than the last accepted one is dropped.
//! Once none has been accepted for the timeout, order begins anew: the sender's clock may have been
//! set back.
class PoseInbox {
 public:
  //! @param frame    fixed frame that poses must be in
  //! @param timeout  [s] age at which a pose counts as lost
  //! @param smoothing  [s] time constant of the filter of positions
  PoseInbox(std::string frame, double timeout, double smoothing)
      : frame_(std::move(frame)), timeout_(timeout), filter_(smoothing) {}

  //! @return why the pose is dropped; empty if it is accepted
  std::string receive(const geometry_msgs::PoseStamped& pose);

  //! Whether there is a pose that is not lost. Its stamp counts, and when it came: a late message
  //! is as useless as none.
  bool fresh(const ros::Time& now) const;

  //! Distance [m] from a position to the newest pose.
  double distanceFrom(const pbd::Vector3& position) const { return (pose_.position - position).norm(); }

  //! The velocity that leads from a pose to where the agent will be in a time [s], at most kMaxSpeed: a
  //! measurement that leaps must not tear the object. The position is filtered, and predicted from the newest
  //! pose's stamp on; the orientation is that of the newest pose.
  pbd::Twist twistFrom(const pbd::Pose& present, const ros::Time& now, double time) const;

  //! [m/s] filtered; zero while no pose is known.
  pbd::Vector3 velocity() const { return received_ ? pbd::Vector3(filter_.velocity()) : pbd::Vector3::Zero(); }

  static constexpr double kMaxSpeed = 2.0;         // m/s
  static constexpr double kMaxAngularSpeed = 6.0;  // rad/s

 private:
  bool silent() const;
  void filter(const pbd::Vector3& position);

  std::string frame_;
  double timeout_;
  bool received_ = false;
  ros::SteadyTime received_at_;
  ros::Time stamp_;
  pbd::Pose pose_;
  ros::Time origin_;  // of the filter's time, whose differences must be exact
  control::PositionFilter filter_;
};

}  // namespace deformable_manipulation
