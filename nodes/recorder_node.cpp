// Records topics into a bag, none of their messages lost; see docs/interfaces.md.
//
// Arguments: path of the bag without its end, a date and .bag; topics.

#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <csignal>
#include <ctime>

#include "../src/ros/bag_recorder.h"

namespace {

volatile std::sig_atomic_t stop_wanted = 0;

std::string dated(const std::string& prefix) {
  const std::time_t now = std::time(nullptr);
  char date[32];
  std::strftime(date, sizeof(date), "_%Y-%m-%d-%H-%M-%S.bag", std::localtime(&now));
  return prefix + date;
}

}  // namespace

int main(int argc, char** argv) {
  // Connections stay until what has come is written.
  ros::init(argc, argv, "recorder", ros::init_options::NoSigintHandler);
  for (const int signal : {SIGINT, SIGTERM}) {
    std::signal(signal, [](int) { stop_wanted = 1; });
  }
  ros::NodeHandle node;
  if (argc < 3) {
    ROS_FATAL("Usage: recorder_node PATH TOPIC...");
    return 1;
  }
  try {
    deformable_manipulation::BagRecorder recorder(node, dated(argv[1]), {argv + 2, argv + argc});
    while (ros::ok() && !stop_wanted) {
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.1));
    }
    ros::getGlobalCallbackQueue()->callAvailable();
  } catch (const rosbag::BagException& error) {
    ROS_FATAL_STREAM("The recording failed: " << error.what() << ".");
    return 1;
  }
  return 0;
}
