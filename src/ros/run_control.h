#pragma once

#include <ros/ros.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <cstdint>
#include <vector>

#include "deformable_manipulation/Step.h"

namespace deformable_manipulation {

//! The services reset, pause and step. They take effect between two cycles.
class RunControl {
 public:
  explicit RunControl(ros::NodeHandle& node);

  //! True once after each reset that was asked for.
  bool takeReset();

  bool resetWanted() const { return reset_wanted_; }

  //! Whether the simulation must not go on.
  bool halted() const { return paused_ && steps_ == 0; }

  //! A cycle begins. Steps asked for from then on come after it.
  void countCycle();

 private:
  bool reset(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool pause(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response);
  bool step(Step::Request& request, Step::Response& response);

  bool reset_wanted_ = false;
  bool paused_ = false;
  std::uint64_t steps_ = 0;  // cycles to make while paused
  std::vector<ros::ServiceServer> servers_;
};

}  // namespace deformable_manipulation
