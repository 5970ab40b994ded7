#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>

#include <vector>

#include "agent_link.h"
#include "deformable_manipulation/pbd/simulation.h"
#include "run_control.h"

namespace deformable_manipulation {

//! How the simulator fares, on /diagnostics once per second of real time: its loop, the object, the agents' inputs.
class SimulatorDiagnostics {
 public:
  //! Keeps references to all but the node.
  SimulatorDiagnostics(ros::NodeHandle& node, const pbd::Simulation& simulation, const std::vector<AgentLink>& links,
                       const RunControl& control, bool lockstep);

  //! From now on the correction of the object is reported, too.
  void watchCorrection();

  //! A cycle's work is done. @param busy [s] that it took
  void countCycle(double busy);

  //! A cycle began later than it was to.
  void countOverrun();

  //! Whether the exact response of the object was found.
  void countResponse(pbd::ResponseStatus status);

 private:
  using Status = diagnostic_updater::DiagnosticStatusWrapper;

  //! What happened since the last report.
  struct Second {
    ros::SteadyTime begun = ros::SteadyTime::now();
    long cycles = 0;
    long overruns = 0;
    long responses = 0;
    long unknown_responses = 0;
    pbd::ResponseStatus why_unknown = pbd::ResponseStatus::VALID;
    double busy = 0.0;  // s
    double busiest = 0.0;
  };

  void report(const ros::SteadyTimerEvent& event);
  void reportLoop(Status& status);
  void reportObject(Status& status);
  void reportCorrection(Status& status);
  void reportAgents(Status& status);

  const pbd::Simulation& simulation_;
  const std::vector<AgentLink>& links_;
  const RunControl& control_;
  bool lockstep_;
  long overruns_ = 0;
  Second now_, last_;
  diagnostic_updater::Updater updater_;
  ros::SteadyTimer timer_;
};

}  // namespace deformable_manipulation
