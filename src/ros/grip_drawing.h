#pragma once

#include <visualization_msgs/Marker.h>

#include "deformable_manipulation/ObjectState.h"

namespace deformable_manipulation {

//! The bar of a grip that holds several particles: lines that join them, as short as they can be. Without points if the
//! grip holds one particle or none.
visualization_msgs::Marker drawGrip(const ObjectState& state, int agent, bool is_leader);

}  // namespace deformable_manipulation
