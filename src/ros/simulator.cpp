#include "simulator.h"

#include <ros/callback_queue.h>
#include <rosgraph_msgs/Clock.h>

#include <algorithm>
#include <cstdio>

#include "object_kinds.h"
#include "state_message.h"

namespace deformable_manipulation {
namespace {

constexpr double kWarningPeriod = 5.0;   // s
constexpr double kOverrunPeriod = 60.0;  // s

// States kept for a subscriber that is slow for a moment: a recorder must not lose any.
constexpr int kQueue = 100;

// Fewer cycles than publishers keep messages for a recorder that is slow.
constexpr long kAheadOfRecorder = 50;

// Simulated time does not begin at zero, which in ROS means "not known yet".
constexpr double kStartOfTime = 1.0;  // s

std::chrono::nanoseconds seconds(double value) { return std::chrono::nanoseconds(static_cast<long>(1e9 * value)); }

//! Handles messages and service calls for a time, or until one has been handled.
void spinFor(double seconds) { ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(seconds)); }

}  // namespace

Simulator::Simulator(const SimulatorScenario& scenario, const SimulatorOptions& options)
    : scenario_(scenario),
      options_(options),
      simulation_(makeBody(scenario), scenario.agents, perturbationsOf(scenario, scenario.perturbation),
                  scenario.clock),
      measured_points_(scenario.frame),
      object_services_(node_, simulation_),
      live_perturbation_(scenario_, simulation_),
      control_(node_),
      visualization_(node_, makeDrawing(scenario.object), scenario.leader(), options.tf_prefix),
      diagnostics_(node_, simulation_, links_, control_, options.lockstep) {
  if (simulation_.rest() != pbd::Rest::STABLE) {
    ROS_WARN("%s", describe(simulation_.rest()));
  }
  const std::string softness = simulation_.body().softness(scenario.clock.time_step, scenario.clock.substeps);
  if (!softness.empty()) {
    ROS_WARN("%s", softness.c_str());
  }
  const bool latch = options_.lockstep;  // whoever connects late gets the state that everybody waits for
  state_publisher_ = node_.advertise<ObjectState>("state", kQueue, latch);
  positions_publisher_ = node_.advertise<AgentPositions>("agent_positions", kQueue, latch);
  waiting_publisher_ = node_.advertise<std_msgs::String>("waiting_for", 1, true);
  if (options_.lockstep) {
    clock_publisher_ = node_.advertise<rosgraph_msgs::Clock>("/clock", 1, latch);
    if (options_.recorded) {
      recorder_subscriber_ = node_.subscribe<std_msgs::Header>(
          "recorded", 1, [this](const std_msgs::HeaderConstPtr& newest) { recorded_ = newest->stamp; }, {},
          ros::TransportHints().tcpNoDelay());
    }
  }
  if (scenario_.correction) {
    simulation_.correct(*scenario_.correction);
    diagnostics_.watchCorrection();
    points_subscriber_ = node_.subscribe<sensor_msgs::PointCloud2>(
        "measured_points", 1, [this](const sensor_msgs::PointCloud2ConstPtr& message) { receivePoints(*message); });
  }
  links_.reserve(scenario_.agents.size());  // they are subscribed with their addresses
  for (std::size_t i = 0; i < scenario_.agents.size(); ++i) {
    const DrivenBy driven_by = options_.follow_poses ? DrivenBy::POSE : scenario_.driven_by[i];
    links_.emplace_back(node_, scenario_.agents[i].name, driven_by, scenario_.frame, options_.pose_namespace,
                        scenario_.command_timeout, scenario_.pose_smoothing, options_.lockstep);
  }
}

void Simulator::run() {
  waitForSubscribers(state_publisher_, options_.state_subscribers);
  waitForSubscribers(positions_publisher_, options_.position_subscribers);
  next_tick_ = SteadyClock::now();
  while (ros::ok() && !atEnd()) {
    if (control_.takeReset()) {
      simulation_.reset();
      for (AgentLink& link : links_) {
        link.reset();
      }
    }
    control_.countCycle();
    const SteadyClock::time_point started = SteadyClock::now();
    noteTime();
    const bool published = agentsAreTrue();
    if (published) {
      publish();
    }
    simulation_.advance();
    if (published) {
      publishPositions();
    }
    diagnostics_.countCycle(std::chrono::duration<double>(SteadyClock::now() - started).count());
    options_.lockstep ? awaitCommands() : awaitTick();
    applyInputs();
    awaitPermission();
  }
  if (ros::ok()) {
    await([this] { return unrecorded(0); });
    ROS_INFO("End of the scenario after %.2f s.", simulation_.time());
  }
  // The console of ROS is closed when the node has been told to leave.
  std::printf("%s: Overruns: %ld of %ld cycles.\n", ros::this_node::getName().c_str(), overruns_, published_);
}

bool Simulator::atEnd() const {
  return options_.stop_at_end && simulation_.time() > scenario_.duration - 0.5 * scenario_.clock.cycleTime();
}

void Simulator::waitForSubscribers(const ros::Publisher& publisher, int wanted) {
  while (ros::ok() && static_cast<int>(publisher.getNumSubscribers()) < wanted) {
    ROS_INFO_STREAM_THROTTLE(kWarningPeriod, "Waiting for subscribers of " << publisher.getTopic() << ": "
                                                                           << publisher.getNumSubscribers() << " of "
                                                                           << wanted << " are there.");
    spinFor(0.01);
  }
}

//! A simulation of agents that are somewhere else must not move any robot. Tells everybody whom it waits for.
bool Simulator::agentsAreTrue() {
  std_msgs::String waiting_for;
  for (std::size_t i = 0; i < links_.size(); ++i) {
    if (!links_[i].isTrue(simulation_.pose(static_cast<int>(i)))) {
      waiting_for.data += (waiting_for.data.empty() ? "" : " and ") + links_[i].awaited();
    }
  }
  if (simulation_.correction() != nullptr && simulation_.correction()->stops()) {
    waiting_for.data += waiting_for.data.empty() ? "" : " and ";
    waiting_for.data += "measured points that agree with the model of the object";
  }
  if (waiting_for.data != waiting_for_.data) {
    waiting_for_ = waiting_for;
    waiting_publisher_.publish(waiting_for_);
  }
  return waiting_for.data.empty();
}

void Simulator::noteTime() {
  stamp_ = options_.lockstep ? ros::Time(kStartOfTime + published_ * scenario_.clock.cycleTime()) : ros::Time::now();
  time_ = simulation_.time();
}

//! What was seen belongs to the model's state of then, however late it comes.
void Simulator::receivePoints(const sensor_msgs::PointCloud2& message) {
  std::string why = measured_points_.read(message);
  if (why.empty()) {
    why = simulation_.measure(time_ + (message.header.stamp - stamp_).toSec(), measured_points_.points());
  }
  if (!why.empty()) {
    ROS_WARN_STREAM_THROTTLE(kWarningPeriod, "Measured points are not used: " << why << ".");
  }
}

void Simulator::publish() {
  const ros::Time stamp = stamp_;
  if (stamp < state_.header.stamp) {
    ROS_WARN("The clock was set back by %.3f s; commands are accepted from now on.",
             (state_.header.stamp - stamp).toSec());
    for (AgentLink& link : links_) {
      link.reset();
    }
  }
  fillState(simulation_, stamp, scenario_.frame, state_);
  addMeasuredVelocities();
  if (scenario_.exact_response) {
    addResponse();
  }
  if (scenario_.turns) {
    fillTurningSensitivities(simulation_, state_);
  }
  if (scenario_.wrenches) {
    fillWrenches(simulation_, state_);
  }
  ++published_;
  if (options_.lockstep) {
    rosgraph_msgs::Clock clock;
    clock.clock = stamp;
    clock_publisher_.publish(clock);
  }
  state_publisher_.publish(state_);
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const int agent = static_cast<int>(i);
    links_[i].publish(simulation_.pose(agent), simulation_.wrench(agent), stamp);
  }
  visualization_.show(state_);
}

//! Comes after the step: on few cores the leader, who is in no hurry, would keep the assistants waiting.
void Simulator::publishPositions() {
  positions_.header = state_.header;
  positions_.cycle = state_.cycle;
  positions_.reset_count = state_.reset_count;
  positions_.agents = state_.agents;
  positions_.agent_positions = state_.agent_positions;
  positions_.agent_orientations = state_.agent_orientations;
  positions_publisher_.publish(positions_);
}

void Simulator::addMeasuredVelocities() {
  state_.measured_velocities.clear();
  if (std::any_of(links_.begin(), links_.end(), [](const AgentLink& link) { return link.followsPoses(); })) {
    for (std::size_t i = 0; i < links_.size(); ++i) {
      const pbd::Vector3 velocity = links_[i].velocity(simulation_.twist(static_cast<int>(i)));
      state_.measured_velocities.insert(state_.measured_velocities.end(), velocity.data(), velocity.data() + 3);
    }
  }
}

void Simulator::addResponse() {
  const pbd::ResponseStatus status = fillSensitivities(simulation_, state_);
  diagnostics_.countResponse(status);
  if (status != pbd::ResponseStatus::VALID) {
    ROS_WARN_STREAM_THROTTLE(kWarningPeriod,
                             "The exact response of the object is not known; its perturbed copies take "
                             "over: "
                                 << pbd::describe(status) << ".");
  }
}

void Simulator::awaitCommands() {
  await([this] {
    const std::string names = unanswered();
    return names.empty() ? unrecorded(kAheadOfRecorder)
                         : "the command of cycle " + std::to_string(state_.cycle) + " from " + names;
  });
}

//! Waits in lock-step for what others have to do first.
//! @param missing  what has not been done; empty if nothing
void Simulator::await(const std::function<std::string()>& missing) {
  SteadyClock::time_point warn_at = SteadyClock::now() + seconds(kWarningPeriod);
  for (std::string what = missing(); ros::ok() && !control_.resetWanted() && !what.empty(); what = missing()) {
    spinFor(0.1);
    if (SteadyClock::now() > warn_at) {
      ROS_WARN_STREAM("Lock-step: still waiting for " << what << ".");
      warn_at = SteadyClock::now() + seconds(kWarningPeriod);
    }
  }
}

//! The recorder, if it lacks states older than so many cycles, or answers to them.
std::string Simulator::unrecorded(long allowed) const {
  const double age = (state_.header.stamp - recorded_).toSec();
  const double cycle_time = scenario_.clock.cycleTime();
  const bool behind = options_.lockstep && options_.recorded && age > (allowed + 0.5) * cycle_time;
  return behind ? "the recorder, which has not written all messages" : "";
}

std::string Simulator::unanswered() const {
  std::string names;
  for (const AgentLink& link : links_) {
    if (!link.answers(state_.header.stamp)) {
      names += (names.empty() ? "" : ", ") + link.name();
    }
  }
  return names;
}

void Simulator::awaitTick() {
  next_tick_ += seconds(scenario_.clock.cycleTime());
  if (SteadyClock::now() > next_tick_) {
    ++overruns_;
    diagnostics_.countOverrun();
    next_tick_ = SteadyClock::now();
    ROS_WARN_THROTTLE(
        kOverrunPeriod,
        "%s: Overruns: %ld of %ld cycles took longer than %.1f ms. If there are many, this machine is too slow "
        "for the run: lower controller.rate, or use lockstep:=true.",
        ros::this_node::getName().c_str(), overruns_, published_, 1e3 * scenario_.clock.cycleTime());
  }
  ros::getGlobalCallbackQueue()->callAvailable();
  for (SteadyClock::time_point now = SteadyClock::now(); ros::ok() && now < next_tick_; now = SteadyClock::now()) {
    spinFor(std::chrono::duration<double>(next_tick_ - now).count());
  }
}

void Simulator::awaitPermission() {
  if (!control_.halted()) {
    return;
  }
  while (ros::ok() && control_.halted() && !control_.resetWanted()) {
    spinFor(0.05);
    visualization_.show(state_);
  }
  next_tick_ = SteadyClock::now();
}

void Simulator::applyInputs() {
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const int agent = static_cast<int>(i);
    simulation_.setCommand(agent, links_[i].twist(simulation_.pose(agent), scenario_.clock.cycleTime()));
  }
}

}  // namespace deformable_manipulation
