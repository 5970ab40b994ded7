#include "fabric_drawing.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "marker_parts.h"

namespace deformable_manipulation {
namespace {

using Eigen::Vector3d;
using visualization_msgs::Marker;

constexpr double kLineWidth = 0.003;  // m
constexpr double kCopyWidth = 0.005;  // m

// RViz lights from where the viewer is, which leaves what faces upwards dark. The colors have the light in them
// instead, from above and for both sides.
const Vector3d kToLight = Vector3d(0.35, -0.25, 0.9).normalized();
constexpr double kAmbient = 0.35;  // the share of light that comes from everywhere
const Vector3d kCloth(0.96, 0.80, 0.52);

template <typename Edges>
Marker lines(const ObjectState& state, const std::string& ns, std::size_t copy, const Edges& edges, double width,
             const std_msgs::ColorRGBA& color) {
  Marker result = emptyMarker(state, ns, static_cast<int>(copy), Marker::LINE_LIST, color);
  result.scale.x = width;
  result.points.reserve(2 * edges.size());
  const double* points = pointsOf(state, copy);
  for (const auto& edge : edges) {
    result.points.push_back(toPoint(points + 3 * edge[0]));
    result.points.push_back(toPoint(points + 3 * edge[1]));
  }
  return result;
}

}  // namespace

std::unique_ptr<ObjectDrawing> FabricDrawing::of(const ParameterSection& object) {
  std::vector<std::array<int, 3>> triangles;
  for (const pbd::Vector3& corners : object.section("mesh").vectors("triangles")) {
    triangles.push_back({static_cast<int>(corners[0]), static_cast<int>(corners[1]), static_cast<int>(corners[2])});
  }
  return std::make_unique<FabricDrawing>(std::move(triangles));
}

FabricDrawing::FabricDrawing(std::vector<std::array<int, 3>> triangles) : triangles_(std::move(triangles)) {
  std::map<Edge, int> uses;
  for (const std::array<int, 3>& triangle : triangles_) {
    for (int side = 0; side < 3; ++side) {
      const auto [first, second] = std::minmax(triangle[side], triangle[(side + 1) % 3]);
      ++uses[{first, second}];
    }
  }
  for (const auto& [edge, count] : uses) {
    edges_.push_back(edge);
    if (count == 1) {
      outline_.push_back(edge);
    }
  }
  if (outline_.empty()) {
    outline_ = edges_;
  }
}

void FabricDrawing::drawObject(const ObjectState& state, visualization_msgs::MarkerArray& to) const {
  to.markers.push_back(surface(state));
  to.markers.push_back(lines(state, "object_lines", 0, edges_, kLineWidth, toColor(0.45, 0.32, 0.15, 0.5)));
}

Marker FabricDrawing::drawCopy(const ObjectState& state, std::size_t copy, const std_msgs::ColorRGBA& color) const {
  return lines(state, "copies", copy, outline_, kCopyWidth, color);
}

Marker FabricDrawing::surface(const ObjectState& state) const {
  Marker result = emptyMarker(state, "object", 0, Marker::TRIANGLE_LIST, toColor(0.0, 0.0, 0.0, 1.0));
  result.scale.x = result.scale.y = result.scale.z = 1.0;
  const double* points = pointsOf(state, 0);
  const std::vector<std_msgs::ColorRGBA> colors = litColors(points, state.point_count);
  result.points.reserve(3 * triangles_.size());
  result.colors.reserve(3 * triangles_.size());
  for (const std::array<int, 3>& triangle : triangles_) {
    for (const int corner : triangle) {
      result.points.push_back(toPoint(points + 3 * corner));
      result.colors.push_back(colors[corner]);
    }
  }
  return result;
}

//! Colors of the points, smooth over the surface.
std::vector<std_msgs::ColorRGBA> FabricDrawing::litColors(const double* points, std::size_t count) const {
  const Eigen::Map<const Eigen::Matrix3Xd> at(points, 3, static_cast<Eigen::Index>(count));
  Eigen::Matrix3Xd normals = Eigen::Matrix3Xd::Zero(3, at.cols());
  for (const std::array<int, 3>& triangle : triangles_) {
    const Vector3d origin = at.col(triangle[0]);
    const Vector3d normal = (at.col(triangle[1]) - origin).cross(at.col(triangle[2]) - origin);
    for (const int corner : triangle) {
      normals.col(corner) += normal;
    }
  }
  std::vector<std_msgs::ColorRGBA> colors;
  colors.reserve(count);
  for (Eigen::Index i = 0; i < at.cols(); ++i) {
    const double facing = std::abs(normals.col(i).normalized().dot(kToLight));
    const Vector3d color = (kAmbient + (1.0 - kAmbient) * facing) * kCloth;
    colors.push_back(toColor(color.x(), color.y(), color.z(), 1.0));
  }
  return colors;
}

}  // namespace deformable_manipulation
