#include "rod_drawing.h"

#include <algorithm>

#include "marker_parts.h"

namespace deformable_manipulation {
namespace {

using visualization_msgs::Marker;

constexpr double kLeastWidth = 0.016;  // m, so that a thin rope can be seen
constexpr double kCopyWidth = 0.005;   // m

Marker line(const ObjectState& state, std::size_t copy, double width, const std::string& ns,
            const std_msgs::ColorRGBA& color) {
  Marker result = emptyMarker(state, ns, static_cast<int>(copy), Marker::LINE_STRIP, color);
  result.scale.x = width;
  const double* at = pointsOf(state, copy);
  for (std::size_t i = 0; i < state.point_count; ++i) {
    result.points.push_back(toPoint(at + 3 * i));
  }
  return result;
}

}  // namespace

std::unique_ptr<ObjectDrawing> RodDrawing::of(const ParameterSection& object) {
  return std::make_unique<RodDrawing>(2.0 * object.number("radius"));
}

RodDrawing::RodDrawing(double diameter) : width_(std::max(diameter, kLeastWidth)) {}

void RodDrawing::drawObject(const ObjectState& state, visualization_msgs::MarkerArray& to) const {
  to.markers.push_back(line(state, 0, width_, "object", toColor(0.55, 0.25, 0.05, 1.0)));
}

Marker RodDrawing::drawCopy(const ObjectState& state, std::size_t copy, const std_msgs::ColorRGBA& color) const {
  return line(state, copy, kCopyWidth, "copies", color);
}

}  // namespace deformable_manipulation
