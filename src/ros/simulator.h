#pragma once

#include <ros/ros.h>
#include <std_msgs/Header.h>
#include <std_msgs/String.h>

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "agent_link.h"
#include "deformable_manipulation/AgentPositions.h"
#include "deformable_manipulation/ObjectState.h"
#include "deformable_manipulation/pbd/simulation.h"
#include "live_perturbation.h"
#include "measured_points_inbox.h"
#include "object_services.h"
#include "run_control.h"
#include "scenario_reader.h"
#include "simulator_diagnostics.h"
#include "visualization.h"

namespace deformable_manipulation {

//! How the simulator node runs.
struct SimulatorOptions {
  bool lockstep = false;
  bool stop_at_end = false;      // leave after the scenario's duration
  bool follow_poses = false;     // all agents are driven by their poses
  std::string pose_namespace;    // prefix of the pose topics followed
  std::string tf_prefix;         // of the agents' frames
  int state_subscribers = 0;     // to wait for before the first state
  int position_subscribers = 0;  // the same of the agents' positions
  bool recorded = false;         // lock-step: do not get far ahead of the recorder
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

  void waitForSubscribers(const ros::Publisher& publisher, int wanted);
  void noteTime();
  void receivePoints(const sensor_msgs::PointCloud2& message);
  void publish();
  void publishPositions();
  void addMeasuredVelocities();
  void addResponse();
  void awaitCommands();
  void await(const std::function<std::string()>& missing);
  void awaitTick();
  void awaitPermission();
  void applyInputs();
  bool agentsAreTrue();
  std::string unanswered() const;
  std::string unrecorded(long allowed) const;
  bool atEnd() const;

  SimulatorScenario scenario_;
  SimulatorOptions options_;
  pbd::Simulation simulation_;
  ros::NodeHandle node_;
  ros::Publisher state_publisher_, positions_publisher_, clock_publisher_, waiting_publisher_;
  ros::Subscriber recorder_subscriber_, points_subscriber_;
  std::vector<AgentLink> links_;  // one per agent
  MeasuredPointsInbox measured_points_;
  ObjectServices object_services_;
  LivePerturbation live_perturbation_;
  RunControl control_;
  Visualization visualization_;
  SimulatorDiagnostics diagnostics_;

  ObjectState state_;
  std_msgs::String waiting_for_;
  AgentPositions positions_;
  long published_ = 0;  // states since the start, over all resets
  long overruns_ = 0;
  ros::Time stamp_;     // of the state at time_
  double time_ = 0.0;   // s, of the simulation, with that stamp
  ros::Time recorded_;  // stamp up to which everything is
  SteadyClock::time_point next_tick_;
};

}  // namespace deformable_manipulation
