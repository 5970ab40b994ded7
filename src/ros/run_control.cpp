#include "run_control.h"

#include <algorithm>
#include <string>

namespace deformable_manipulation {

RunControl::RunControl(ros::NodeHandle& node) {
  servers_ = {node.advertiseService("reset", &RunControl::reset, this),
              node.advertiseService("pause", &RunControl::pause, this),
              node.advertiseService("step", &RunControl::step, this)};
}

bool RunControl::takeReset() {
  const bool wanted = reset_wanted_;
  reset_wanted_ = false;
  return wanted;
}

void RunControl::countCycle() {
  if (paused_ && steps_ > 0) {
    --steps_;
  }
}

bool RunControl::reset(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  reset_wanted_ = true;
  response.success = true;
  response.message = "Returns to the settled start in the next cycle.";
  return true;
}

bool RunControl::pause(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response) {
  paused_ = request.data;
  steps_ = 0;
  response.success = true;
  response.message = paused_ ? "Paused; call step to advance by cycles." : "Continues.";
  return true;
}

bool RunControl::step(Step::Request& request, Step::Response& response) {
  response.success = paused_;
  if (paused_) {
    const unsigned cycles = std::max<unsigned>(request.cycles, 1);
    steps_ += cycles;
    response.message = "Continues for " + std::to_string(cycles) + " cycles.";
  } else {
    response.message = "Nothing changed: the simulation is not paused; call pause with data: true first.";
  }
  return true;
}

}  // namespace deformable_manipulation
