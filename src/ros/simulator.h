#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <std_srvs/Trigger.h>

#include "command_inbox.h"
#include "deformable_manipulation/ClearPerturbations.h"
#include "deformable_manipulation/ObjectState.h"
#include "deformable_manipulation/SetPerturbations.h"
#include "deformable_manipulation/pbd/simulation.h"
#include "object_markers.h"
#include "scenario_reader.h"

namespace deformable_manipulation {

//! How the simulator node runs.
struct SimulatorOptions {
  bool lockstep = false;
  bool stop_at_end = false;      // leave after the scenario's duration
  int state_subscribers = 0;     // to wait for before the first state
};

//! The simulation as a ROS node: states out, commands in (docs/interfaces.md).
class Simulator {
 public:
  //! Settles the object, then offers topics and services.
  //! @throw pbd::ParameterError, pbd::NonFiniteState
  Simulator(const SimulatorScenario& scenario, const SimulatorOptions& options);

  //! Runs until ROS shuts down or the scenario's end.
  //! @throw pbd::NonFiniteState
  void run();

 private:
  using SteadyClock = std::chrono::steady_clock;

  void advertise();
  void waitForNodes();
  void publish();
  void publishClock();
  void drawMarkers();
  void awaitCommands();
  void awaitTick();
  void applyCommands();
  void receive(std::size_t agent, const geometry_msgs::TwistStamped& command);
  std::string unanswered() const;
  bool atEnd() const;

  bool reset(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool setPerturbations(SetPerturbations::Request& request, SetPerturbations::Response& response);
  bool clearPerturbations(ClearPerturbations::Request& request, ClearPerturbations::Response& response);
  int agentNamed(const std::string& name) const;
  std::string listAgents() const;

  SimulatorScenario scenario_;
  SimulatorOptions options_;
  pbd::Simulation simulation_;
  ObjectMarkers markers_;

  ros::NodeHandle node_;
  ros::Publisher state_publisher_, clock_publisher_, marker_publisher_;
  std::vector<ros::Publisher> pose_publishers_;
  std::vector<ros::Subscriber> command_subscribers_;
  std::vector<ros::ServiceServer> services_;
  std::vector<CommandInbox> inboxes_;

  ObjectState state_;
  long published_ = 0;              // states since the start, over all resets
  bool reset_wanted_ = false;
  long overruns_ = 0;
  SteadyClock::time_point next_tick_;
  SteadyClock::time_point last_markers_;
};

}  // namespace deformable_manipulation
