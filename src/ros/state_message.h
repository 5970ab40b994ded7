#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/WrenchStamped.h>
#include <ros/time.h>

#include <string>

#include "deformable_manipulation/ObjectState.h"
#include "deformable_manipulation/pbd/simulation.h"

namespace deformable_manipulation {

//! Writes the present state of all copies into a message; its arrays are used again.
void fillState(const pbd::Simulation& simulation, const ros::Time& stamp, const std::string& frame,
               ObjectState& message);

//! Writes the exact response of the object to its agents into a message; empty if it is not known.
pbd::ResponseStatus fillSensitivities(pbd::Simulation& simulation, ObjectState& message);

//! Writes the exact response to turned grips, if fillSensitivities() has found the other one.
void fillTurningSensitivities(const pbd::Simulation& simulation, ObjectState& message);

//! Writes what all copies exert on the agents and, if fillSensitivities() has found it, its exact response.
void fillWrenches(const pbd::Simulation& simulation, ObjectState& message);

geometry_msgs::WrenchStamped toWrench(const pbd::Wrench& wrench, const ros::Time& stamp, const std::string& frame);

geometry_msgs::PoseStamped toPose(const pbd::Pose& pose, const ros::Time& stamp, const std::string& frame);

}  // namespace deformable_manipulation
