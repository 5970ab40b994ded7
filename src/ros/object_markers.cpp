#include "object_markers.h"

#include <algorithm>
#include <cmath>

#include "grip_drawing.h"
#include "marker_parts.h"

namespace deformable_manipulation {
namespace {

using visualization_msgs::Marker;

constexpr double kAgentDiameter = 0.07;  // m
constexpr double kTextHeight = 0.09;     // m
constexpr double kNameHeight = 0.17;     // m above the agent, clear of the copies of usual displacements

//! Red, green or blue, as the axes of a frame in RViz.
std_msgs::ColorRGBA axisColor(const double* displacement) {
  const double size[3] = {std::abs(displacement[0]), std::abs(displacement[1]), std::abs(displacement[2])};
  const long axis = std::max_element(size, size + 3) - size;
  return toColor(axis == 0 ? 0.9 : 0.1, axis == 1 ? 0.7 : 0.1, axis == 2 ? 0.9 : 0.1, 0.6);
}

void drawAgent(const ObjectState& state, int index, bool is_leader, visualization_msgs::MarkerArray& array) {
  const double* at = &state.agent_positions[3 * index];
  Marker ball = emptyMarker(state, "agents", index, Marker::SPHERE, agentColor(is_leader, 1.0));
  ball.pose.position = toPoint(at);
  ball.scale.x = ball.scale.y = ball.scale.z = kAgentDiameter;
  array.markers.push_back(ball);
  Marker name = emptyMarker(state, "agent_names", index, Marker::TEXT_VIEW_FACING, toColor(0.1, 0.1, 0.1, 1.0));
  name.pose.position = ball.pose.position;
  name.pose.position.z += kNameHeight;
  name.scale.z = kTextHeight;
  name.text = state.agents[index];
  array.markers.push_back(name);
}

}  // namespace

visualization_msgs::MarkerArray ObjectMarkers::draw(const ObjectState& state) {
  visualization_msgs::MarkerArray array;
  drawing_->drawObject(state, array);
  const std::size_t copies = state.displaced_agents.size();
  for (std::size_t copy = 1; copy < copies; ++copy) {
    array.markers.push_back(drawing_->drawCopy(state, copy, axisColor(&state.displacements[3 * copy])));
  }
  for (std::size_t copy = copies; copy < copies_drawn_; ++copy) {
    Marker gone = emptyMarker(state, "copies", static_cast<int>(copy), Marker::LINE_STRIP, toColor(0.0, 0.0, 0.0, 0.0));
    gone.action = Marker::DELETE;
    array.markers.push_back(gone);
  }
  copies_drawn_ = copies;
  bars_drawn_.resize(state.agents.size(), false);
  for (std::size_t i = 0; i < state.agents.size(); ++i) {
    drawAgent(state, static_cast<int>(i), state.agents[i] == leader_, array);
    drawBar(state, static_cast<int>(i), array);
  }
  return array;
}

void ObjectMarkers::drawBar(const ObjectState& state, int agent, visualization_msgs::MarkerArray& array) {
  Marker bar = drawGrip(state, agent, state.agents[agent] == leader_);
  const bool is_drawn = !bar.points.empty();
  if (is_drawn || bars_drawn_[agent]) {
    bar.action = is_drawn ? Marker::ADD : Marker::DELETE;
    array.markers.push_back(bar);
  }
  bars_drawn_[agent] = is_drawn;
}

}  // namespace deformable_manipulation
