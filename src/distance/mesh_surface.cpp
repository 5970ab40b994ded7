#include "mesh_surface.h"

#include "search_stack.h"

namespace deformable_manipulation {
namespace distance {
namespace {

constexpr double kSquaredSlack = 1e-9;  // of a squared distance, far more than rounding
constexpr double kTiny = 1e-200;        // m^2

}  // namespace

MeshSurface::MeshSurface(const MeshPart& part)
    : vertices_(part.vertices), triangles_(part.triangles), closed_(part.closed), endless_(part.endless) {
  std::vector<Box> leaves(triangles_.size());
  for (std::size_t t = 0; t < leaves.size(); ++t) {
    leaves[t] = boxAround(corners(static_cast<int>(t)));
  }
  tree_ = buildBoxTree(leaves);
  sortLikeTree();
  discs_ = buildDiscTree(tree_, [this](int triangle) { return corners(triangle); });
  if (closed_) {
    neighbours_ = edgeNeighbours(triangles_, vertices_.size());
    sumCornerNormals();
  }
}

//! What is near each other in space is so in memory.
void MeshSurface::sortLikeTree() {
  std::vector<Triangle> triangles;
  triangles.reserve(triangles_.size());
  for (BoxNode& node : tree_) {
    for (int& child : node.children) {
      if (child < 0) {
        triangles.push_back(triangles_[~child]);
        child = ~static_cast<int>(triangles.size() - 1);
      }
    }
  }
  std::vector<int> renumbered(vertices_.size(), -1);
  std::vector<Vector3> vertices;
  vertices.reserve(vertices_.size());
  for (Triangle& triangle : triangles) {
    for (int& vertex : triangle) {
      if (renumbered[vertex] < 0) {
        renumbered[vertex] = static_cast<int>(vertices.size());
        vertices.push_back(vertices_[vertex]);
      }
      vertex = renumbered[vertex];
    }
  }
  triangles_ = std::move(triangles);
  vertices_ = std::move(vertices);
}

void MeshSurface::sumCornerNormals() {
  corner_normals_.assign(vertices_.size(), Eigen::Vector3f::Zero());
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const Corners<3> c = corners(static_cast<int>(t));
    const Vector3 normal = unitNormal(static_cast<int>(t));
    for (int k = 0; k < 3; ++k) {
      const Vector3 one = c[(k + 1) % 3] - c[k], other = c[(k + 2) % 3] - c[k];
      const double angle = std::atan2(one.cross(other).norm(), one.dot(other));
      corner_normals_[triangles_[t][k]] += (angle * normal).cast<float>();
    }
  }
}

SurfacePoint MeshSurface::nearest(const Vector3& point, int hint, double enough) const {
  SurfacePoint found;
  double least = INFINITY;
  if (hint >= 0) {  // a bound only, so that what is found does not depend on it
    least = nearestOnTriangle(point, corners(hint)).squared * (1.0 + kSquaredSlack) + kTiny;
  }
  const auto improve = [&](int triangle) {
    const NearestOnTriangle here = nearestOnTriangle(point, corners(triangle));
    if (here.squared < least) {
      least = here.squared;
      found.triangle = triangle;
      found.weights = here.weights;
    }
  };
  Box box;
  box.include(point);
  const FloatElement<1> element({point});
  SearchStack<int> stack;
  stack.push(0.0F, 0);
  const double squared_enough = enough > 0.0 ? enough * enough : -1.0;
  while (!stack.empty() && !(found.triangle >= 0 && least <= squared_enough)) {
    const SearchStack<int>::Entry entry = stack.pop();
    if (entry.bound >= least) {
      continue;
    }
    if (entry.what < 0) {
      improve(~entry.what);
      continue;
    }
    const FourFloats by_boxes = tree_[entry.what].squaredDistances(box);
    const FourFloats by_discs = discs_[entry.what].squaredDistances(element);
    const FourFloats bounds = larger(by_boxes, by_discs);
    const NearChildren near(bounds, bounds, least);
    for (int i = 0; i < near.count(); ++i) {
      stack.push(bounds[near.slot(i)], tree_[entry.what].children[near.slot(i)]);
    }
  }
  if (found.triangle < 0 && hint >= 0) {  // rounding, where the hint is as near as can be
    return nearest(point);
  }
  found.distance = std::sqrt(least);
  if (closed_ && pseudonormal(found).dot(point - position(found)) < 0.0) {
    found.distance = -found.distance;
  }
  return found;
}

double MeshSurface::heightAlong(const Vector3& normal, const HeightRange& range, const Box& box,
                                double squared_reach) const {
  double highest = range.lowest;
  const Eigen::Vector3f along = normal.cast<float>();
  SearchStack<int> stack;
  stack.push(INFINITY, 0);
  while (!stack.empty() && highest <= range.enough) {
    const SearchStack<int>::Entry entry = stack.pop();
    if (entry.bound <= highest) {
      continue;
    }
    if (entry.what < 0) {
      for (const Vector3& corner : corners(~entry.what)) {
        highest = std::max(highest, normal.dot(corner));
      }
      continue;
    }
    const BoxNode& node = tree_[entry.what];
    const FourFloats away = node.squaredDistances(box), heights = node.heightsAlong(along);
    for (int slot = 0; slot < 4; ++slot) {
      if (node.children[slot] != BoxNode::kNone && away[slot] <= squared_reach && heights[slot] > highest) {
        stack.push(heights[slot], node.children[slot]);
      }
    }
  }
  return highest > range.enough ? INFINITY : highest;
}

Vector3 MeshSurface::pseudonormal(const SurfacePoint& place) const {
  const Weights& w = place.weights;
  const int zeros = (w[0] == 0.0) + (w[1] == 0.0) + (w[2] == 0.0);
  if (!closed_ || zeros == 0) {
    return unitNormal(place.triangle);
  }
  if (zeros == 1) {
    const int edge = w[0] == 0.0 ? 1 : w[1] == 0.0 ? 2 : 0;
    return unitNormal(place.triangle) + unitNormal(neighbours_[place.triangle][edge]);
  }
  const int corner = w[0] != 0.0 ? 0 : w[1] != 0.0 ? 1 : 2;
  return corner_normals_[triangles_[place.triangle][corner]].cast<double>();
}

}  // namespace distance
}  // namespace deformable_manipulation
