#include "trail_markers.h"

#include <cmath>

#include "marker_parts.h"

namespace deformable_manipulation {
namespace {

using visualization_msgs::Marker;

constexpr double kSpacing = 0.01;       // m between the points of a trail
constexpr std::size_t kLongest = 2000;  // points; older ones go
constexpr double kWidth = 0.008;        // m

Marker emptyTrail(int agent, bool is_leader) {
  Marker trail;
  trail.ns = "trails";
  trail.id = agent;
  trail.type = Marker::LINE_STRIP;
  trail.action = Marker::ADD;
  trail.pose.orientation.w = 1.0;
  trail.scale.x = kWidth;
  trail.color = agentColor(is_leader, 0.5);
  return trail;
}

double distance(const geometry_msgs::Point& a, const geometry_msgs::Point& b) {
  return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

}  // namespace

void TrailMarkers::add(const ObjectState& state) {
  if (state.reset_count != reset_count_ || trails_.size() != state.agents.size()) {
    reset_count_ = state.reset_count;
    trails_.clear();
    for (std::size_t i = 0; i < state.agents.size(); ++i) {
      trails_.push_back(emptyTrail(static_cast<int>(i), state.agents[i] == leader_));
    }
  }
  for (std::size_t i = 0; i < trails_.size(); ++i) {
    Marker& trail = trails_[i];
    trail.header = state.header;
    geometry_msgs::Point here;
    here.x = state.agent_positions[3 * i];
    here.y = state.agent_positions[3 * i + 1];
    here.z = state.agent_positions[3 * i + 2];
    if (trail.points.empty() || distance(trail.points.back(), here) > kSpacing) {
      trail.points.push_back(here);
    }
    if (trail.points.size() > kLongest) {
      trail.points.erase(trail.points.begin(), trail.points.begin() + kLongest / 10);
    }
  }
}

visualization_msgs::MarkerArray TrailMarkers::draw() const {
  visualization_msgs::MarkerArray array;
  for (const Marker& trail : trails_) {
    array.markers.push_back(trail);
    if (trail.points.size() < 2) {  // RViz complains about a line without length
      array.markers.back().action = Marker::DELETE;
    }
  }
  return array;
}

}  // namespace deformable_manipulation
