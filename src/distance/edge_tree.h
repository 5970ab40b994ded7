#pragma once

#include <vector>

#include "planar_ring.h"

namespace deformable_manipulation {
namespace distance {

constexpr int kGroup = 4;  //!< edges that are compared at once

//! Some edges, the last one repeated where there are fewer than kGroup.
struct EdgeGroup {
  double start_u[kGroup], start_v[kGroup];
  double end_u[kGroup], end_v[kGroup];
  double middle_u[kGroup], middle_v[kGroup];
  double direction_u[kGroup], direction_v[kGroup];
  double half[kGroup];  // m, half the length
  int index[kGroup];    // in the ring
};

//! The edge nearest to a point.
struct NearestEdge {
  int edge = -1;              //!< of several equally near ones, the first in the ring
  double squared = INFINITY;  //!< [m^2] distance
};

//! How far boxes are at least from a point [m^2].
struct PointBound {
  double operator()(const Box2& box) const { return box.squaredDistance(point); }
  Point2 point;
};

//! How far boxes are at least from a segment [m^2].
struct SegmentBound {
  explicit SegmentBound(const Segment2& s) : segment(s) {
    box.add(s.start);
    box.add(s.end);
  }

  double operator()(const Box2& other) const {
    const double u = std::max(std::max(box.lower.u - other.upper.u, other.lower.u - box.upper.u), 0.0);
    const double v = std::max(std::max(box.lower.v - other.upper.v, other.lower.v - box.upper.v), 0.0);
    const Point2 half = 0.5 * (other.upper - other.lower), direction = segment.direction;
    const double aside = std::fabs(segment.across(other.lower + half)) - std::fabs(direction.v) * half.u -
                         std::fabs(direction.u) * half.v;
    return std::max(u * u + v * v, aside > 0.0 ? aside * aside : 0.0);
  }

  Segment2 segment;
  Box2 box;
};

//! The edges of a ring in a tree of boxes, to find those near something.
class EdgeTree {
 public:
  explicit EdgeTree(const PlanarRing& ring);

  //! @param guess an edge that is likely to be near, or any other; the result does not depend on it
  NearestEdge nearest(const Point2& point, int guess) const;

  //! A limit [m^2] for visitNear that rounding cannot make too small for what is as far as `squared` [m^2]
  //! from a point or segment at `place`.
  double limitFor(double squared, const Point2& place) const {
    const double size = normBound(place) + size_;
    return squared * (1.0 + 1e-6) + 1e-22 * size * size;
  }

  //! Calls visit(group) for all groups with an edge within a distance, and others, the nearer boxes first.
  //! @param bound how far a box is at least: PointBound or SegmentBound
  //! @param limit [m^2] the distance squared, which visit may lower
  template <typename Bound, typename Visit>
  void visitNear(const Bound& bound, const double& limit, Visit&& visit) const;

 private:
  struct Node {
    Box2 box;
    int first_child = -1;  // the second one follows; none in a leaf
    int group = -1;
  };
  struct Waiting {
    int node;
    double squared;
  };

  void build(int node, int* first, int* last);
  void addGroup(const int* first, const int* last);

  const PlanarRing& ring_;
  const double size_;  // m, of the ring
  std::vector<Node> nodes_;
  std::vector<EdgeGroup> groups_;
};

template <typename Bound, typename Visit>
void EdgeTree::visitNear(const Bound& bound, const double& limit, Visit&& visit) const {
  Waiting waiting[64];  // the tree is balanced: one of them for each level
  int count = 0;
  waiting[count++] = {0, bound(nodes_[0].box)};
  while (count > 0) {
    const Waiting next = waiting[--count];
    if (next.squared > limit) {
      continue;
    }
    const Node& node = nodes_[next.node];
    if (node.first_child < 0) {
      visit(groups_[node.group]);
      continue;
    }
    Waiting nearer = {node.first_child, bound(nodes_[node.first_child].box)};
    Waiting farther = {node.first_child + 1, bound(nodes_[node.first_child + 1].box)};
    if (farther.squared < nearer.squared) {
      std::swap(nearer, farther);
    }
    waiting[count] = farther;
    count += farther.squared <= limit;
    waiting[count] = nearer;
    count += nearer.squared <= limit;
  }
}

}  // namespace distance
}  // namespace deformable_manipulation
