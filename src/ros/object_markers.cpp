#include "object_markers.h"

#include <algorithm>
#include <cmath>

namespace deformable_manipulation {
namespace {

using visualization_msgs::Marker;

constexpr double kLeastWidth = 0.016;    // m, so that a thin rope can be seen
constexpr double kCopyWidth = 0.005;     // m
constexpr double kAgentDiameter = 0.07;  // m
constexpr double kTextHeight = 0.09;     // m
constexpr double kNameHeight = 0.17;     // m above the agent, clear of the copies of usual displacements

std_msgs::ColorRGBA color(double r, double g, double b, double a) {
  std_msgs::ColorRGBA result;
  result.r = r;
  result.g = g;
  result.b = b;
  result.a = a;
  return result;
}

geometry_msgs::Point point(const double* xyz) {
  geometry_msgs::Point result;
  result.x = xyz[0];
  result.y = xyz[1];
  result.z = xyz[2];
  return result;
}

Marker marker(const ObjectState& state, const std::string& ns, int id, int type, const std_msgs::ColorRGBA& color) {
  Marker result;
  result.header = state.header;
  result.ns = ns;
  result.id = id;
  result.type = type;
  result.action = Marker::ADD;
  result.color = color;
  result.pose.orientation.w = 1.0;
  return result;
}

Marker line(const ObjectState& state, std::size_t copy, double width, const std::string& ns,
            const std_msgs::ColorRGBA& color) {
  Marker result = marker(state, ns, static_cast<int>(copy), Marker::LINE_STRIP, color);
  result.scale.x = width;
  const double* at = state.points.data() + 3 * state.point_count * copy;
  for (std::size_t i = 0; i < state.point_count; ++i) {
    result.points.push_back(point(at + 3 * i));
  }
  return result;
}

//! Red, green or blue, as the axes of a frame in RViz.
std_msgs::ColorRGBA axisColor(const double* displacement) {
  const double size[3] = {std::abs(displacement[0]), std::abs(displacement[1]), std::abs(displacement[2])};
  const long axis = std::max_element(size, size + 3) - size;
  return color(axis == 0 ? 0.9 : 0.1, axis == 1 ? 0.7 : 0.1, axis == 2 ? 0.9 : 0.1, 0.6);
}

void drawAgent(const ObjectState& state, int index, visualization_msgs::MarkerArray& array) {
  const double* at = &state.agent_positions[3 * index];
  Marker ball = marker(state, "agents", index, Marker::SPHERE, color(0.95, 0.6, 0.1, 1.0));
  ball.pose.position = point(at);
  ball.scale.x = ball.scale.y = ball.scale.z = kAgentDiameter;
  array.markers.push_back(ball);
  Marker name = marker(state, "agent_names", index, Marker::TEXT_VIEW_FACING, color(0.1, 0.1, 0.1, 1.0));
  name.pose.position = ball.pose.position;
  name.pose.position.z += kNameHeight;
  name.scale.z = kTextHeight;
  name.text = state.agents[index];
  array.markers.push_back(name);
}

}  // namespace

ObjectMarkers::ObjectMarkers(double diameter) : width_(std::max(diameter, kLeastWidth)) {}

visualization_msgs::MarkerArray ObjectMarkers::draw(const ObjectState& state) {
  visualization_msgs::MarkerArray array;
  array.markers.push_back(line(state, 0, width_, "object", color(0.55, 0.25, 0.05, 1.0)));
  const std::size_t copies = state.displaced_agents.size();
  for (std::size_t copy = 1; copy < copies; ++copy) {
    array.markers.push_back(line(state, copy, kCopyWidth, "copies", axisColor(&state.displacements[3 * copy])));
  }
  for (std::size_t copy = copies; copy < copies_drawn_; ++copy) {
    Marker gone = marker(state, "copies", static_cast<int>(copy), Marker::LINE_STRIP, color(0.0, 0.0, 0.0, 0.0));
    gone.action = Marker::DELETE;
    array.markers.push_back(gone);
  }
  copies_drawn_ = copies;
  for (std::size_t i = 0; i < state.agents.size(); ++i) {
    drawAgent(state, static_cast<int>(i), array);
  }
  return array;
}

}  // namespace deformable_manipulation
