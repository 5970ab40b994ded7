#include "marker_parts.h"

namespace deformable_manipulation {

std_msgs::ColorRGBA toColor(double red, double green, double blue, double alpha) {
  std_msgs::ColorRGBA result;
  result.r = static_cast<float>(red);
  result.g = static_cast<float>(green);
  result.b = static_cast<float>(blue);
  result.a = static_cast<float>(alpha);
  return result;
}

std_msgs::ColorRGBA agentColor(bool is_leader, double alpha) {
  return is_leader ? toColor(0.95, 0.6, 0.1, alpha) : toColor(0.1, 0.5, 0.6, alpha);
}

geometry_msgs::Point toPoint(const double* xyz) {
  geometry_msgs::Point result;
  result.x = xyz[0];
  result.y = xyz[1];
  result.z = xyz[2];
  return result;
}

visualization_msgs::Marker emptyMarker(const ObjectState& state, const std::string& ns, int id, int type,
                                       const std_msgs::ColorRGBA& color) {
  visualization_msgs::Marker result;
  result.header = state.header;
  result.ns = ns;
  result.id = id;
  result.type = type;
  result.action = visualization_msgs::Marker::ADD;
  result.color = color;
  result.pose.orientation.w = 1.0;
  return result;
}

}  // namespace deformable_manipulation
