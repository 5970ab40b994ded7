#include "fabric_mesh.h"

#include <algorithm>

namespace deformable_manipulation {
namespace pbd {
namespace {

//! A side of a triangle.
struct Side {
  std::array<int, 2> vertices;
  int triangle;
  int opposite;
};

std::vector<Side> sortedSides(const std::vector<Triangle>& triangles) {
  std::vector<Side> sides;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int a = triangles[t][(k + 1) % 3];
      const int b = triangles[t][(k + 2) % 3];
      sides.push_back({{std::min(a, b), std::max(a, b)}, static_cast<int>(t), triangles[t][k]});
    }
  }
  std::stable_sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.vertices < b.vertices; });
  return sides;
}

//! Cotangent of the angle at a corner between the directions to two points.
double cotangent(const Vector3& corner, const Vector3& a, const Vector3& b) {
  return (a - corner).dot(b - corner) / (a - corner).cross(b - corner).norm();
}

}  // namespace

double triangleArea(const std::vector<Vector3>& vertices, const Triangle& t) {
  return 0.5 * (vertices[t[1]] - vertices[t[0]]).cross(vertices[t[2]] - vertices[t[0]]).norm();
}

std::vector<MeshEdge> meshEdges(const std::vector<Vector3>& vertices, const std::vector<Triangle>& triangles) {
  std::vector<MeshEdge> edges;
  for (const Side& side : sortedSides(triangles)) {
    const double area = triangleArea(vertices, triangles[side.triangle]);
    if (!edges.empty() && edges.back().vertices == side.vertices) {
      edges.back().triangles[1] = side.triangle;
      edges.back().opposite[1] = side.opposite;
      edges.back().area += area;
    } else {
      const double length = (vertices[side.vertices[0]] - vertices[side.vertices[1]]).norm();
      edges.push_back({side.vertices, {side.triangle, -1}, {side.opposite, -1}, length, area});
    }
  }
  return edges;
}

std::array<double, 4> foldWeights(const std::vector<Vector3>& vertices, const MeshEdge& edge) {
  const Vector3& start = vertices[edge.vertices[0]];
  const Vector3& end = vertices[edge.vertices[1]];
  std::array<double, 4> weights{};
  for (int side = 0; side < 2; ++side) {
    const Vector3& opposite = vertices[edge.opposite[side]];
    const double at_start = cotangent(start, end, opposite);
    const double at_end = cotangent(end, start, opposite);
    weights[0] -= at_end;
    weights[1] -= at_start;
    weights[2 + side] = at_start + at_end;
  }
  return weights;
}

}  // namespace pbd
}  // namespace deformable_manipulation
