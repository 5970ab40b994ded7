#include <algorithm>

#include "mesh_cleaning.h"

namespace deformable_manipulation {
namespace distance {
namespace {

//! An edge of a triangle, listed with the smaller one of its vertices.
struct Side {
  int other;  // the larger vertex
  int triangle, corner;
};

}  // namespace

std::vector<Triangle> edgeNeighbours(const std::vector<Triangle>& triangles, std::size_t vertices) {
  std::vector<int> start(vertices + 2, 0);
  for (const Triangle& t : triangles) {
    for (int k = 0; k < 3; ++k) {
      ++start[std::min(t[k], t[(k + 1) % 3]) + 2];
    }
  }
  for (std::size_t v = 2; v < start.size(); ++v) {
    start[v] += start[v - 1];
  }
  std::vector<Side> sides(3 * triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const int a = triangles[i][k], b = triangles[i][(k + 1) % 3];
      sides[start[std::min(a, b) + 1]++] = {std::max(a, b), static_cast<int>(i), k};
    }
  }
  std::vector<Triangle> neighbours(triangles.size(), {kBoundary, kBoundary, kBoundary});
  for (std::size_t v = 0; v < vertices; ++v) {
    const auto begin = sides.begin() + start[v], end = sides.begin() + start[v + 1];
    std::sort(begin, end, [](const Side& a, const Side& b) {
      return a.other < b.other || (a.other == b.other && a.triangle < b.triangle);
    });
    for (auto first = begin; first != end;) {
      const auto last = std::find_if(first, end, [&](const Side& side) { return side.other != first->other; });
      if (last - first == 2) {
        neighbours[first[0].triangle][first[0].corner] = first[1].triangle;
        neighbours[first[1].triangle][first[1].corner] = first[0].triangle;
      } else if (last - first > 2) {
        std::for_each(first, last, [&](const Side& side) { neighbours[side.triangle][side.corner] = kCrowded; });
      }
      first = last;
    }
  }
  return neighbours;
}

}  // namespace distance
}  // namespace deformable_manipulation
