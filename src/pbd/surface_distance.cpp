#include "surface_distance.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace deformable_manipulation {
namespace pbd {
namespace {

using Point = std::pair<double, double>;

// How flat and how convex a mesh must be, as parts of its size and area: meshes come from files in single precision.
constexpr double kFlat = 1e-6;
constexpr double kConvex = 1e-6;

double turn(const Point& a, const Point& b, const Point& c) {
  return (b.first - a.first) * (c.second - a.second) - (b.second - a.second) * (c.first - a.first);
}

//! Andrew's monotone chain, once for the lower and once for the upper half.
double hullArea(std::vector<Point> points) {
  std::sort(points.begin(), points.end());
  std::vector<Point> hull;
  for (int half = 0; half < 2; ++half) {
    const std::size_t start = hull.size();
    for (const Point& point : points) {
      while (hull.size() >= start + 2 && turn(hull[hull.size() - 2], hull.back(), point) <= 0.0) {
        hull.pop_back();
      }
      hull.push_back(point);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  double twice = 0.0;
  for (std::size_t i = 2; i < hull.size(); ++i) {
    twice += turn(hull[0], hull[i - 1], hull[i]);
  }
  return 0.5 * twice;
}

bool flatAndConvex(const std::vector<Vector3>& vertices, const std::vector<Triangle>& triangles) {
  Eigen::Matrix3Xd points(3, vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    points.col(static_cast<int>(i)) = vertices[i];
  }
  points.colwise() -= points.rowwise().mean().eval();
  const Eigen::Matrix3d frame =
      Eigen::JacobiSVD<Eigen::Matrix3d>(points * points.transpose(), Eigen::ComputeFullU).matrixU();
  points = frame.transpose() * points;
  if (points.row(2).cwiseAbs().maxCoeff() > kFlat * points.row(0).cwiseAbs().maxCoeff()) {
    return false;
  }
  std::vector<Point> in_plane;
  in_plane.reserve(points.cols());
  for (int i = 0; i < points.cols(); ++i) {
    in_plane.emplace_back(points(0, i), points(1, i));
  }
  double area = 0.0;
  for (const Triangle& triangle : triangles) {
    area += triangleArea(vertices, triangle);
  }
  return std::abs(hullArea(std::move(in_plane)) - area) < kConvex * area;
}

//! [m] Between the vertices opposite to an edge, over the edge, its triangles unfolded; infinite if the straight line
//! passes by the edge.
double acrossEdge(const std::vector<Vector3>& vertices, const MeshEdge& edge) {
  const Vector3& start = vertices[edge.vertices[0]];
  const Vector3 along = (vertices[edge.vertices[1]] - start) / edge.length;
  double x[2], y[2];
  for (int side = 0; side < 2; ++side) {
    const Vector3 arm = vertices[edge.opposite[side]] - start;
    x[side] = along.dot(arm);
    y[side] = (arm - x[side] * along).norm();
  }
  const double crossing = (x[0] * y[1] + x[1] * y[0]) / (y[0] + y[1]);
  const bool over = crossing >= 0.0 && crossing <= edge.length;
  return over ? std::hypot(x[1] - x[0], y[0] + y[1]) : std::numeric_limits<double>::infinity();
}

}  // namespace

SurfaceDistance::SurfaceDistance(const std::vector<Vector3>& vertices, const std::vector<Triangle>& triangles,
                                 const std::vector<MeshEdge>& edges)
    : vertices_(vertices), straight_(flatAndConvex(vertices, triangles)), ways_(vertices.size()) {
  for (const MeshEdge& edge : edges) {
    addWay(edge.vertices[0], edge.vertices[1], edge.length);
    if (edge.interior()) {
      addWay(edge.opposite[0], edge.opposite[1], acrossEdge(vertices, edge));
    }
  }
}

void SurfaceDistance::addWay(int a, int b, double length) {
  if (std::isfinite(length)) {
    ways_[a].push_back({b, length});
    ways_[b].push_back({a, length});
  }
}

std::vector<double> SurfaceDistance::from(int vertex) const {
  std::vector<double> distance(ways_.size(), std::numeric_limits<double>::infinity());
  using Reached = std::pair<double, int>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<Reached>> open;  // Dijkstra
  distance[vertex] = 0.0;
  open.push({0.0, vertex});
  while (!open.empty()) {
    const auto [length, at] = open.top();
    open.pop();
    if (length > distance[at]) {
      continue;
    }
    for (const Way& way : ways_[at]) {
      if (length + way.length < distance[way.to]) {
        distance[way.to] = length + way.length;
        open.push({distance[way.to], way.to});
      }
    }
  }
  return distance;
}

}  // namespace pbd
}  // namespace deformable_manipulation
