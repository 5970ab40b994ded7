#include "bag_recorder.h"

#include <std_msgs/Header.h>

#include <algorithm>
#include <cstdio>
#include <sstream>

namespace deformable_manipulation {
namespace {

const char* const kActive = ".active";

//! Whether messages of this definition begin with a header.
bool beginsWithHeader(const std::string& definition) {
  std::istringstream lines(definition);
  std::string line, type;
  while (std::getline(lines, line)) {
    if (std::istringstream(line) >> type && type[0] != '#') {
      return type == "Header" || type == "std_msgs/Header";
    }
  }
  return false;
}

}  // namespace

BagRecorder::BagRecorder(ros::NodeHandle& node, const std::string& path, const std::vector<std::string>& topics)
    : path_(path), bag_(path + kActive, rosbag::bagmode::Write) {
  bag_.setCompression(rosbag::compression::LZ4);  // keeps up with any run, which bz2 does not
  recorded_ = node.advertise<std_msgs::Header>("recorded", 1, true);
  topics_.reserve(topics.size());  // they are subscribed with their addresses
  for (const std::string& name : topics) {
    topics_.push_back({name, {}});
    subscribe(node, topics_.back());
  }
}

BagRecorder::~BagRecorder() {
  for (Topic& topic : topics_) {
    topic.subscriber.shutdown();
  }
  bag_.close();
  if (std::rename((path_ + kActive).c_str(), path_.c_str()) != 0) {
    ROS_ERROR_STREAM("The bag keeps the name " << path_ << kActive << ": it cannot be renamed.");
  }
}

void BagRecorder::subscribe(ros::NodeHandle& node, Topic& topic) {
  constexpr std::uint32_t kWithoutLimit = 0;
  ros::SubscribeOptions options;
  options.init<topic_tools::ShapeShifter>(topic.name, kWithoutLimit, {});
  options.helper = boost::make_shared<ros::SubscriptionCallbackHelperT<const Event&>>(
      [this, &topic](const Event& event) { write(topic, event); });
  options.transport_hints = ros::TransportHints().tcpNoDelay();
  topic.subscriber = node.subscribe(options);
}

void BagRecorder::write(Topic& topic, const Event& event) {
  const topic_tools::ShapeShifter& message = *event.getConstMessage();
  // Simulated time may not have begun.
  const ros::Time time = std::max(event.getReceiptTime(), ros::TIME_MIN);
  bag_.write(topic.name, time, message, event.getConnectionHeaderPtr());
  noteStamp(topic, message);
  acknowledge();
}

void BagRecorder::noteStamp(Topic& topic, const topic_tools::ShapeShifter& message) {
  if (topic.newest.isZero()) {
    topic.awaited = beginsWithHeader(message.getMessageDefinition());
  }
  if (topic.awaited) {
    serialized_.resize(message.size());
    ros::serialization::OStream out(serialized_.data(), message.size());
    message.write(out);
    ros::serialization::IStream in(serialized_.data(), message.size());
    std_msgs::Header header;
    ros::serialization::deserialize(in, header);
    topic.newest = header.stamp;
  }
}

//! Tells up to which stamp every topic is written, if that has changed.
void BagRecorder::acknowledge() {
  std_msgs::Header header;
  header.stamp = ros::TIME_MAX;
  for (const Topic& topic : topics_) {
    if (topic.awaited) {
      header.stamp = std::min(header.stamp, topic.newest);
    }
  }
  if (header.stamp != acknowledged_ && header.stamp != ros::TIME_MAX) {
    acknowledged_ = header.stamp;
    recorded_.publish(header);
  }
}

}  // namespace deformable_manipulation
