#include "agent_link.h"

#include <algorithm>
#include <sstream>

#include "state_message.h"

namespace deformable_manipulation {
namespace {

constexpr double kWarningPeriod = 5.0;  // s
constexpr int kQueue = 10;

// A simulation that is started, or gets poses again after a gap, first has to catch up.
constexpr double kCaughtUp = 0.05;  // m

std::string seconds(double value) {
  std::ostringstream text;
  text << value << " s";
  return text.str();
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) {
    text += (text.empty() ? "" : " and ") + name;
  }
  return text;
}

}  // namespace

AgentLink::AgentLink(ros::NodeHandle& node, const std::string& name, DrivenBy driven_by, const std::string& frame,
                     const std::string& pose_namespace, double timeout, double pose_smoothing, bool lockstep)
    : name_(name),
      driven_by_(driven_by),
      frame_(frame),
      timeout_(timeout),
      lockstep_(lockstep),
      commands_(frame),
      poses_(frame, timeout, pose_smoothing) {
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  wrench_publisher_ = node.advertise<geometry_msgs::WrenchStamped>(name + "/wrench", 1);
  if (followsPoses()) {
    subscriber_ = node.subscribe(pose_namespace + name + "/pose", kQueue, &AgentLink::receivePose, this, hints);
  } else {
    pose_publisher_ = node.advertise<geometry_msgs::PoseStamped>(name + "/pose", 1);
    subscriber_ = node.subscribe(name + "/cmd_vel", kQueue, &AgentLink::receiveCommand, this, hints);
  }
}

void AgentLink::publish(const pbd::Pose& pose, const pbd::Wrench& wrench, const ros::Time& stamp) {
  newest_state_ = stamp;
  if (pose_publisher_.getNumSubscribers() > 0) {
    pose_publisher_.publish(toPose(pose, stamp, frame_));
  }
  if (wrench_publisher_.getNumSubscribers() > 0) {
    wrench_publisher_.publish(toWrench(wrench, stamp, frame_));
  }
}

bool AgentLink::answers(const ros::Time& state) const { return followsPoses() || commands_.answers(state); }

pbd::Twist AgentLink::twist(const pbd::Pose& present, double cycle_time) const {
  if (driven_by_ == DrivenBy::COMMAND) {
    return commanded();
  }
  const ros::Time now = ros::Time::now();
  return poses_.fresh(now) ? poses_.twistFrom(present, now, cycle_time) : pbd::Twist();
}

bool AgentLink::isTrue(const pbd::Pose& present) const {
  if (driven_by_ == DrivenBy::COMMAND) {
    return true;
  }
  if (!poses_.fresh(ros::Time::now())) {
    warn("is lost: no pose on " + subscriber_.getTopic() + " newer than " + seconds(timeout_) +
         "; no states are published until one arrives");
    return false;
  }
  return poses_.distanceFrom(present.position) < kCaughtUp;
}

std::string AgentLink::awaited() const {
  return poses_.fresh(ros::Time::now()) ? name_ + " to reach its pose"
                                        : "the pose of " + name_ + " on " + subscriber_.getTopic();
}

pbd::Twist AgentLink::commanded() const {
  const std::vector<std::string> senders = presentSenders();
  if (senders.size() > 1) {
    warn("stands still: " + std::to_string(senders.size()) + " nodes send commands on " + subscriber_.getTopic() +
         ", " + joined(senders) + "; stop all but one");
    return pbd::Twist();
  }
  if (lockstep_) {
    return commands_.command();
  }
  const ros::Time now = ros::Time::now();
  if (commands_.timedOut(now, timeout_)) {
    warn("stands still: no command on " + subscriber_.getTopic() + " for more than " + seconds(timeout_));
  }
  return commands_.command(now, timeout_);
}

std::string AgentLink::fault() const {
  const ros::Time now = ros::Time::now();
  if (driven_by_ == DrivenBy::POSE) {
    return poses_.fresh(now) ? "" : "no pose for more than " + seconds(timeout_);
  }
  if (!commands_.known()) {
    return "no command yet";
  }
  if (presentSenders().size() > 1) {
    return "commands from " + joined(presentSenders());
  }
  return !lockstep_ && commands_.timedOut(now, timeout_) ? "no command for more than " + seconds(timeout_) : "";
}

void AgentLink::reset() { commands_.reset(); }

//! Who sends commands at present. The number of connections does not tell: that to a node that was
//! killed is kept.
std::vector<std::string> AgentLink::presentSenders() const {
  const ros::SteadyTime now = ros::SteadyTime::now();
  std::vector<std::string> names;
  for (const auto& sender : senders_) {
    if ((now - sender.second).toSec() <= timeout_) {
      names.push_back(sender.first);
    }
  }
  return names;
}

void AgentLink::receiveCommand(const ros::MessageEvent<geometry_msgs::TwistStamped const>& event) {
  senders_[event.getPublisherName()] = ros::SteadyTime::now();
  const ros::Time latest = lockstep_ ? newest_state_ : ros::Time::now() + ros::Duration(timeout_);
  const std::string fault = commands_.receive(*event.getConstMessage(), latest);
  if (!fault.empty()) {
    warn("ignores a command: " + fault);
  }
}

void AgentLink::receivePose(const geometry_msgs::PoseStamped::ConstPtr& pose) {
  const std::string fault = poses_.receive(*pose);
  if (!fault.empty()) {
    warn("ignores a pose: " + fault);
  }
}

void AgentLink::warn(const std::string& text) const {
  std::string kind = text;
  kind.erase(std::remove_if(kind.begin(), kind.end(), [](char c) { return c == '.' || ('0' <= c && c <= '9'); }),
             kind.end());
  const ros::SteadyTime now = ros::SteadyTime::now();
  if (now > quiet_until_[kind]) {
    quiet_until_[kind] = now + ros::WallDuration(kWarningPeriod);
    ROS_WARN_STREAM("Agent " << name_ << " " << text << ".");
  }
}

}  // namespace deformable_manipulation
