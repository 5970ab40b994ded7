#pragma once

#include <vector>

#include "box_tree.h"
#include "triangle_geometry.h"

namespace deformable_manipulation {
namespace distance {

//! A point, segment or triangle as discs are compared with.
template <std::size_t N>
struct FloatElement {
  explicit FloatElement(const std::array<Vector3, N>& points) {
    Vector3 mean = Vector3::Zero();
    for (const Vector3& point : points) {
      mean += point / double(N);
    }
    centre = mean.template cast<float>();
    for (std::size_t k = 0; k < N; ++k) {
      arms[k] = (points[k] - mean).template cast<float>();
      radius = std::max(radius, arms[k].norm() * (1.0F + 1e-6F));
    }
    rounding = 4e-7F * centre.template lpNorm<1>();
    if (N == 3) {
      const Vector3 across = (points[1] - points[0]).cross(points[N - 1] - points[0]);
      const double length = across.norm();
      normal = (length > 0.0 ? Vector3(across / (length * (1.0 + 1e-6))) : across).template cast<float>();
    }
  }

  Eigen::Vector3f centre;
  std::array<Eigen::Vector3f, N> arms;               // from the centre to the corners
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  // unit vector of a triangle, or zero
  float radius = 0.0F, rounding;
};

//! For each of a box tree's nodes, flat round discs that its children lie in.
//!
//! A small piece of a smooth surface is flat: its disc tells its distance from a point that is farther away than its
//! size much better than its box does. Only pieces of up to kLargest triangles have one.
class DiscNode {
 public:
  static constexpr std::size_t kLargest = 1024;

  DiscNode() {
    normal_.fill(FourFloats{});
    centre_.fill(FourFloats{});
    radius_ = half_thickness_ = FourFloats{INFINITY, INFINITY, INFINITY, INFINITY};
  }

  //! @param triangles of the child, at least one
  void set(int slot, const std::vector<Corners<3>>& triangles);

  //! Lower bounds [m^2] of the squared distances between the children and an element.
  template <std::size_t N>
  FourFloats squaredDistances(const FloatElement<N>& element) const {
    const std::array<FourFloats, 3> arm = {element.centre[0] - centre_[0], element.centre[1] - centre_[1],
                                           element.centre[2] - centre_[2]};
    const FourFloats along = arm[0] * normal_[0] + arm[1] * normal_[1] + arm[2] * normal_[2];
    FourFloats lowest = FourFloats{} + INFINITY, highest = FourFloats{} - INFINITY;
    for (const Eigen::Vector3f& to_corner : element.arms) {
      const FourFloats at = to_corner[0] * normal_[0] + to_corner[1] * normal_[1] + to_corner[2] * normal_[2];
      lowest = at < lowest ? at : lowest;
      highest = larger(at, highest);
    }
    const FourFloats gap = larger(-highest - along, lowest + along) - half_thickness_ - element.rounding;
    const FourFloats bounds = squaredGaps(arm, along, gap, element.radius + element.rounding);
    return N == 3 ? larger(bounds, squared(overPlane(element.normal, arm) - element.rounding)) : bounds;
  }

  //! Lower bounds [m^2] of the squared distances along a direction.
  //! @param direction a unit vector, but for rounding
  template <std::size_t N>
  FourFloats squaredDistancesAlong(const Eigen::Vector3f& direction, const FloatElement<N>& element) const {
    float lowest = INFINITY;
    for (const Eigen::Vector3f& to_corner : element.arms) {
      lowest = std::min(lowest, direction.dot(to_corner));
    }
    const std::array<FourFloats, 3> arm = {element.centre[0] - centre_[0], element.centre[1] - centre_[1],
                                           element.centre[2] - centre_[2]};
    const FourFloats gap = along(direction, arm) + lowest - reach(direction);
    return squared(gap * (1.0F - 1e-6F) - (element.rounding + 4e-7F * element.radius));
  }

  //! A closer lower bound [m^2] for one child that has a disc, otherwise 0. The plane through the element's nearest
  //! point to the disc's centre, square to the way between them, has the whole element on one side.
  template <int K>
  double squaredDistance(int slot, const Corners<K>& element) const {
    const double radius = radius_[slot];
    if (!(radius < INFINITY)) {
      return 0.0;
    }
    const Vector3 centre(centre_[0][slot], centre_[1][slot], centre_[2][slot]);
    const Vector3 normal(normal_[0][slot], normal_[1][slot], normal_[2][slot]);
    const Vector3 way = centre - nearestOnElement<K>(centre, element);
    const double squared = way.squaredNorm(), along = normal.dot(way);
    const double length = std::sqrt(squared);
    const double sine = std::sqrt(std::max(1.0 - along * along / squared, 0.0) + 1e-9);
    const double gap = length - radius * sine - half_thickness_[slot];
    return gap > 0.0 ? gap * gap : 0.0;
  }

 private:
  //! How far the discs are away from an element's plane.
  FourFloats overPlane(const Eigen::Vector3f& normal, const std::array<FourFloats, 3>& arm) const {
    return absolute(along(normal, arm)) - reach(normal);
  }

  static FourFloats along(const Eigen::Vector3f& direction, const std::array<FourFloats, 3>& arm) {
    return direction[0] * arm[0] + direction[1] * arm[1] + direction[2] * arm[2];
  }

  //! How far the discs reach from their centres along a direction.
  FourFloats reach(const Eigen::Vector3f& direction) const {
    const FourFloats cosine = along(direction, normal_);
    return radius_ * squareRoot(larger(1.0F + 4e-6F - cosine * cosine, FourFloats{})) + half_thickness_;
  }

  FourFloats squaredGaps(const std::array<FourFloats, 3>& arm, const FourFloats& along, const FourFloats& gap,
                         float radius) const {
    const FourFloats squared_arm = arm[0] * arm[0] + arm[1] * arm[1] + arm[2] * arm[2];
    // Sideways, what is left of the arm; less what rounding of the difference can have added.
    const FourFloats sideways = squared_arm * (1.0F - 2e-6F) - along * along;
    return squared(gap) + squared(squareRoot(larger(sideways, FourFloats{})) - radius_ - radius);
  }

  //! Of a gap, 0 if there is none.
  static FourFloats squared(const FourFloats& gap) {
    const FourFloats open = larger(gap, FourFloats{});
    return open * open * (1.0F - 2e-6F);
  }

  static FourFloats squareRoot(const FourFloats& of) {
    return FourFloats{std::sqrt(of[0]), std::sqrt(of[1]), std::sqrt(of[2]), std::sqrt(of[3])};
  }

  std::array<FourFloats, 3> normal_;    // unit vectors, or zero: a ball
  std::array<FourFloats, 3> centre_;    // m
  FourFloats radius_, half_thickness_;  // m
};

//! @param corners_of gives the corners of a leaf's triangle
template <typename CornersOf>
std::vector<DiscNode> buildDiscTree(const BoxTree& tree, const CornersOf& corners_of) {
  std::vector<DiscNode> discs(tree.size());
  std::vector<std::size_t> sizes(tree.size(), 0);
  std::vector<Corners<3>> triangles;
  std::vector<int> stack;
  for (std::size_t n = tree.size(); n-- > 0;) {  // children come after their parents
    for (int slot = 0; slot < 4; ++slot) {
      const int child = tree[n].children[slot];
      if (child == BoxNode::kNone) {
        continue;
      }
      const std::size_t size = child < 0 ? 1 : sizes[child];
      sizes[n] += size;
      if (size > DiscNode::kLargest) {
        continue;
      }
      triangles.clear();
      stack.assign(1, child);
      while (!stack.empty()) {
        const int next = stack.back();
        stack.pop_back();
        if (next < 0) {
          triangles.push_back(corners_of(~next));
        } else if (next != BoxNode::kNone) {
          stack.insert(stack.end(), tree[next].children.begin(), tree[next].children.end());
        }
      }
      discs[n].set(slot, triangles);
    }
  }
  return discs;
}

}  // namespace distance
}  // namespace deformable_manipulation
