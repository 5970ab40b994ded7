#pragma once

#include <ros/ros.h>
#include <rosbag/bag.h>
#include <topic_tools/shape_shifter.h>

#include <cstdint>
#include <string>
#include <vector>

namespace deformable_manipulation {

//! Writes topics of any type into a bag, without losing a message however slow the disk is: what has
//! come waits without limit, and the topic `recorded` tells up to which stamp everything is written,
//! so that a lock-step run does not get ahead farther than publishers keep messages.
class BagRecorder {
 public:
  //! @param path  of the bag; while it is written ".active" follows
  //! @throw rosbag::BagException: the file cannot be written
  BagRecorder(ros::NodeHandle& node, const std::string& path, const std::vector<std::string>& topics);

  //! Writes what is left, and finishes the bag.
  ~BagRecorder();

 private:
  struct Topic {
    std::string name;
    ros::Subscriber subscriber;
    bool awaited = true;    // one message for every state
    ros::Time newest = {};  // stamp
  };
  using Event = ros::MessageEvent<topic_tools::ShapeShifter const>;

  void subscribe(ros::NodeHandle& node, Topic& topic);
  void write(Topic& topic, const Event& event);
  void noteStamp(Topic& topic, const topic_tools::ShapeShifter& message);
  void acknowledge();

  std::string path_;
  rosbag::Bag bag_;
  std::vector<Topic> topics_;
  std::vector<std::uint8_t> serialized_;
  ros::Publisher recorded_;
  ros::Time acknowledged_;
};

}  // namespace deformable_manipulation
