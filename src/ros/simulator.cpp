#include "simulator.h"

#include <ros/callback_queue.h>

#include "deformable_manipulation/pbd/rod.h"
#include "state_message.h"

namespace deformable_manipulation {
namespace {

constexpr double kMarkerPeriod = 0.04;   // s, of real time
constexpr double kWarningPeriod = 5.0;   // s

// Simulated time does not begin at zero, which in ROS means "not known yet".
constexpr double kStartOfTime = 1.0;  // s

std::chrono::nanoseconds seconds(double value) { return std::chrono::nanoseconds(static_cast<long>(1e9 * value)); }

}  // namespace

Simulator::Simulator(const SimulatorScenario& scenario, const SimulatorOptions& options)
    : scenario_(scenario),
      options_(options),
      simulation_(std::make_unique<pbd::Rod>(scenario.rod), scenario.agents, scenario.perturbations, scenario.clock),
      markers_(2.0 * scenario.rod.radius),
      inboxes_(scenario.agents.size(), CommandInbox(scenario.frame)) {
  if (!simulation_.settled()) {
    ROS_WARN("The object still moved after a minute of settling; it starts as it is. A higher object.damping or more "
             "simulation.substeps help.");
  }
  advertise();
}

void Simulator::advertise() {
  const bool latch = options_.lockstep;  // whoever connects late gets the state that everybody waits for
  state_publisher_ = node_.advertise<ObjectState>("state", 1, latch);
  marker_publisher_ = node_.advertise<visualization_msgs::MarkerArray>("markers", 2);
  if (options_.lockstep) {
    clock_publisher_ = node_.advertise<rosgraph_msgs::Clock>("/clock", 1, latch);
  }
  for (std::size_t i = 0; i < scenario_.agents.size(); ++i) {
    const std::string& name = scenario_.agents[i].name;
    pose_publishers_.push_back(node_.advertise<geometry_msgs::PoseStamped>(name + "/pose", 1));
    command_subscribers_.push_back(node_.subscribe<geometry_msgs::TwistStamped>(
        name + "/cmd_vel", 10,
        [this, i](const geometry_msgs::TwistStamped::ConstPtr& command) { receive(i, *command); }, ros::VoidConstPtr(),
        ros::TransportHints().tcpNoDelay()));
  }
  services_ = {node_.advertiseService("reset", &Simulator::reset, this),
               node_.advertiseService("set_perturbations", &Simulator::setPerturbations, this),
               node_.advertiseService("clear_perturbations", &Simulator::clearPerturbations, this)};
}

void Simulator::run() {
  waitForNodes();
  next_tick_ = SteadyClock::now();
  while (ros::ok() && !atEnd()) {
    publish();
    simulation_.advance();
    options_.lockstep ? awaitCommands() : awaitTick();
    applyCommands();
    if (reset_wanted_) {
      reset_wanted_ = false;
      simulation_.reset();
      for (CommandInbox& inbox : inboxes_) {
        inbox.reset();
      }
    }
  }
  if (ros::ok()) {
    ROS_INFO("End of the scenario after %.2f s; %ld overruns.", simulation_.time(), overruns_);
  }
}

bool Simulator::atEnd() const {
  return options_.stop_at_end && simulation_.time() > scenario_.duration - 0.5 * scenario_.clock.cycleTime();
}

void Simulator::waitForNodes() {
  while (ros::ok() && static_cast<int>(state_publisher_.getNumSubscribers()) < options_.state_subscribers) {
    ROS_INFO_STREAM_THROTTLE(kWarningPeriod, "Waiting for " << options_.state_subscribers << " subscribers of "
                                                            << state_publisher_.getTopic() << "; there are "
                                                            << state_publisher_.getNumSubscribers() << ".");
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.01));
  }
}

void Simulator::publish() {
  const ros::Time stamp = options_.lockstep ? ros::Time(kStartOfTime + published_ * scenario_.clock.cycleTime())
                                            : ros::Time::now();
  fillState(simulation_, stamp, scenario_.frame, state_);
  ++published_;
  publishClock();
  state_publisher_.publish(state_);
  for (std::size_t i = 0; i < pose_publishers_.size(); ++i) {
    if (pose_publishers_[i].getNumSubscribers() > 0) {
      pose_publishers_[i].publish(toPose(simulation_.pose(static_cast<int>(i)), stamp, scenario_.frame));
    }
  }
  drawMarkers();
}

void Simulator::publishClock() {
  if (options_.lockstep) {
    rosgraph_msgs::Clock clock;
    clock.clock = state_.header.stamp;
    clock_publisher_.publish(clock);
  }
}

void Simulator::drawMarkers() {
  const SteadyClock::time_point now = SteadyClock::now();
  if (marker_publisher_.getNumSubscribers() > 0 && now - last_markers_ > seconds(kMarkerPeriod)) {
    last_markers_ = now;
    marker_publisher_.publish(markers_.draw(state_));
  }
}

void Simulator::awaitCommands() {
  SteadyClock::time_point warn_at = SteadyClock::now() + seconds(kWarningPeriod);
  while (ros::ok() && !reset_wanted_ && !unanswered().empty()) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.1));
    if (SteadyClock::now() > warn_at) {
      ROS_WARN_STREAM("Lock-step: still waiting for the command of cycle " << state_.cycle << " from "
                                                                           << unanswered() << ".");
      warn_at = SteadyClock::now() + seconds(kWarningPeriod);
    }
  }
}

std::string Simulator::unanswered() const {
  std::string names;
  for (std::size_t i = 0; i < inboxes_.size(); ++i) {
    if (!inboxes_[i].answers(state_.header.stamp)) {
      names += (names.empty() ? "" : ", ") + scenario_.agents[i].name;
    }
  }
  return names;
}

void Simulator::awaitTick() {
  next_tick_ += seconds(scenario_.clock.cycleTime());
  if (SteadyClock::now() > next_tick_) {
    ++overruns_;
    next_tick_ = SteadyClock::now();
    ROS_WARN_THROTTLE(kWarningPeriod, "Overrun: %ld of %ld cycles took longer than %.1f ms; the simulation lags behind.",
                      overruns_, published_, 1e3 * scenario_.clock.cycleTime());
  }
  ros::getGlobalCallbackQueue()->callAvailable();
  for (SteadyClock::time_point now = SteadyClock::now(); ros::ok() && now < next_tick_; now = SteadyClock::now()) {
    const double left = std::chrono::duration<double>(next_tick_ - now).count();
    ros::getGlobalCallbackQueue()->callOne(ros::WallDuration(left));
  }
}

void Simulator::applyCommands() {
  const ros::Time now = ros::Time::now();
  for (std::size_t i = 0; i < inboxes_.size(); ++i) {
    const CommandInbox& inbox = inboxes_[i];
    if (!options_.lockstep && inbox.timedOut(now, scenario_.command_timeout)) {
      ROS_WARN_STREAM_THROTTLE(kWarningPeriod, "Agent " << scenario_.agents[i].name
                                                        << " stands still: no command for more than "
                                                        << scenario_.command_timeout << " s.");
    }
    simulation_.setCommand(static_cast<int>(i), options_.lockstep
                                                    ? inbox.command()
                                                    : inbox.command(now, scenario_.command_timeout));
  }
}

void Simulator::receive(std::size_t agent, const geometry_msgs::TwistStamped& command) {
  const std::string fault = inboxes_[agent].receive(command, state_.header.stamp);
  if (!fault.empty()) {
    ROS_WARN_STREAM_THROTTLE(kWarningPeriod,
                             "A command of " << scenario_.agents[agent].name << " is dropped: " << fault << ".");
  }
}

bool Simulator::reset(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  reset_wanted_ = true;  // between two cycles, so that no state is published half reset
  response.success = true;
  response.message = "Back to the settled start with the next cycle.";
  return true;
}

int Simulator::agentNamed(const std::string& name) const {
  for (std::size_t i = 0; i < scenario_.agents.size(); ++i) {
    if (scenario_.agents[i].name == name) {
      return static_cast<int>(i);
    }
  }
  throw std::invalid_argument("there is no agent '" + name + "'; there are " + listAgents());
}

std::string Simulator::listAgents() const {
  std::string names;
  for (const pbd::Agent& agent : scenario_.agents) {
    names += (names.empty() ? "" : ", ") + agent.name;
  }
  return names;
}

bool Simulator::setPerturbations(SetPerturbations::Request& request, SetPerturbations::Response& response) {
  std::vector<int> added;
  std::vector<int> present;
  for (const pbd::PerturbedCopy& copy : simulation_.body().copies()) {
    present.push_back(copy.id);
  }
  try {
    if (request.agents.size() != request.displacements.size()) {
      throw std::invalid_argument("agents and displacements must have the same length");
    }
    for (std::size_t i = 0; i < request.agents.size(); ++i) {
      const geometry_msgs::Vector3& d = request.displacements[i];
      added.push_back(simulation_.addPerturbation({agentNamed(request.agents[i]), pbd::Vector3(d.x, d.y, d.z)}));
    }
    if (request.replace) {
      simulation_.removePerturbations(present);
    }
    response.success = true;
    response.message = "There are " + std::to_string(simulation_.body().copies().size()) + " perturbed copies.";
  } catch (const std::logic_error& error) {
    simulation_.removePerturbations(added);  // all or nothing
    response.success = false;
    response.message = std::string("Nothing changed: ") + error.what() + ".";
  }
  return true;
}

bool Simulator::clearPerturbations(ClearPerturbations::Request& request, ClearPerturbations::Response& response) {
  try {
    std::vector<int> agents;
    for (const std::string& name : request.agents) {
      agents.push_back(agentNamed(name));
    }
    if (agents.empty()) {
      for (std::size_t i = 0; i < scenario_.agents.size(); ++i) {
        agents.push_back(static_cast<int>(i));
      }
    }
    for (int agent : agents) {
      simulation_.clearPerturbations(agent);
    }
    response.success = true;
    response.message = "There are " + std::to_string(simulation_.body().copies().size()) + " perturbed copies.";
  } catch (const std::invalid_argument& error) {
    response.success = false;
    response.message = std::string("Nothing changed: ") + error.what() + ".";
  }
  return true;
}

}  // namespace deformable_manipulation
