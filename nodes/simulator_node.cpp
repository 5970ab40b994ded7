// Simulates the carried object, its perturbed copies and the agents; see docs/interfaces.md.

#include <ros/ros.h>

#include "../src/ros/simulator.h"
#include "deformable_manipulation/pbd/errors.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "simulator");
  ros::NodeHandle node;
  ros::NodeHandle own("~");
  XmlRpc::XmlRpcValue scenario;
  if (!node.getParam("scenario", scenario)) {
    ROS_FATAL_STREAM("Parameter " << node.resolveName("scenario")
                                  << " is missing: start with launch/run.launch, which checks the scenario file and "
                                     "sets the parameter.");
    return 1;
  }
  deformable_manipulation::SimulatorOptions options;
  own.param("lockstep", options.lockstep, options.lockstep);
  own.param("stop_at_end", options.stop_at_end, options.stop_at_end);
  own.param("follow_poses", options.follow_poses, options.follow_poses);
  own.param("pose_namespace", options.pose_namespace, options.pose_namespace);
  own.param("tf_prefix", options.tf_prefix, options.tf_prefix);
  own.param("state_subscribers", options.state_subscribers, options.state_subscribers);
  own.param("position_subscribers", options.position_subscribers, options.position_subscribers);
  own.param("recorded", options.recorded, options.recorded);
  try {
    deformable_manipulation::Simulator(deformable_manipulation::readScenario(scenario), options).run();
  } catch (const deformable_manipulation::pbd::ParameterError& error) {
    ROS_FATAL_STREAM("The scenario cannot be simulated:\n" << error.what());
    return 1;
  } catch (const deformable_manipulation::pbd::NonFiniteState& error) {
    ROS_FATAL_STREAM("The simulation stopped: " << error.what() << ".");
    return 1;
  }
  return 0;
}
