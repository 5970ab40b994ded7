#pragma once

#include <ros/ros.h>

#include <chrono>
#include <cstdint>
#include <string>

#include "deformable_manipulation/ObjectState.h"
#include "object_markers.h"
#include "trail_markers.h"

namespace deformable_manipulation {

//! Markers and tf of the states while somebody subscribes, at most 25 times per second; a large fabric
//! less often, so that drawing it does not hold up the simulation.
class Visualization {
 public:
  //! @param leader  its name
  //! @param tf_prefix  put before the agents' names to make their tf frames
  Visualization(ros::NodeHandle& node, std::unique_ptr<ObjectDrawing> drawing, const std::string& leader,
                std::string tf_prefix);

  void show(const ObjectState& state);

 private:
  void sendTransforms(const ObjectState& state);

  ObjectMarkers object_;
  TrailMarkers trails_;
  std::string tf_prefix_;
  ros::Publisher markers_, transforms_;
  std::chrono::microseconds period_;
  std::chrono::steady_clock::time_point last_;
  ros::Time transforms_stamp_;
  std::uint32_t listeners_ = 0;  // subscribers of the transforms at the last time
};

}  // namespace deformable_manipulation
