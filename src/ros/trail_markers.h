#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <string>
#include <utility>
#include <vector>

#include "deformable_manipulation/ObjectState.h"

namespace deformable_manipulation {

//! The paths that the agents have taken, for RViz.
class TrailMarkers {
 public:
  //! @param leader  its name
  explicit TrailMarkers(std::string leader) : leader_(std::move(leader)) {}

  //! Takes in where the agents are; begins anew after a reset.
  void add(const ObjectState& state);

  visualization_msgs::MarkerArray draw() const;

 private:
  std::string leader_;
  std::uint32_t reset_count_ = 0;
  std::vector<visualization_msgs::Marker> trails_;  // one per agent
};

}  // namespace deformable_manipulation
