#pragma once

#include <visualization_msgs/Marker.h>

#include <string>

#include "deformable_manipulation/ObjectState.h"

namespace deformable_manipulation {

std_msgs::ColorRGBA toColor(double red, double green, double blue, double alpha);

//! The leader and the assistants tell apart by their colours.
std_msgs::ColorRGBA agentColor(bool is_leader, double alpha);

//! From three numbers [m].
geometry_msgs::Point toPoint(const double* xyz);

//! A marker of a state, without content.
visualization_msgs::Marker emptyMarker(const ObjectState& state, const std::string& ns, int id, int type,
                                       const std_msgs::ColorRGBA& color);

//! The geometry points of one copy [point_count x 3].
inline const double* pointsOf(const ObjectState& state, std::size_t copy) {
  return state.points.data() + 3 * state.point_count * copy;
}

}  // namespace deformable_manipulation
