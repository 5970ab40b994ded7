// Draws states that somebody else publishes, such as a recording's, as the simulator draws its own; see
// docs/interfaces.md.

#include <ros/ros.h>

#include "../src/ros/object_kinds.h"
#include "../src/ros/scenario_reader.h"
#include "../src/ros/visualization.h"
#include "deformable_manipulation/pbd/errors.h"

namespace dm = deformable_manipulation;

namespace {

constexpr double kRedrawPeriod = 0.1;  // s, for viewers that come late
constexpr int kEveryState = 0;         // the queue has no end: trails are of all states

void draw(ros::NodeHandle& node, const dm::SimulatorScenario& scenario) {
  dm::Visualization visualization(node, dm::makeDrawing(scenario.object), scenario.leader(), "");
  dm::ObjectState::ConstPtr newest;
  const auto subscriber = node.subscribe<dm::ObjectState>("state", kEveryState, [&](const auto& state) {
    newest = state;
    visualization.show(*newest);
  });
  const auto timer = node.createWallTimer(ros::WallDuration(kRedrawPeriod), [&](const ros::WallTimerEvent&) {
    if (newest) {
      visualization.show(*newest);
    }
  });
  ros::spin();
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "state_markers");
  ros::NodeHandle node;
  XmlRpc::XmlRpcValue scenario;
  if (!node.getParam("scenario", scenario)) {
    ROS_FATAL_STREAM("Parameter " << node.resolveName("scenario") << " is missing: start with launch/playback.launch.");
    return 1;
  }
  try {
    draw(node, dm::readScenario(scenario));
  } catch (const dm::pbd::ParameterError& error) {
    ROS_FATAL_STREAM("The scenario cannot be drawn:\n" << error.what());
    return 1;
  }
  return 0;
}
