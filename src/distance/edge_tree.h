#pragma once

#include <vector>

#include "four.h"
#include "planar_boundary.h"

namespace deformable_manipulation {
namespace distance {

constexpr int kGroup = 4;  //!< edges, or boxes, that are compared at once

//! Four points of the plane.
struct FourPoints {
  void set(int k, const Point2& point) {
    u.set(k, point.u);
    v.set(k, point.v);
  }

  Four u, v;
};

//! Some edges, the last one repeated where there are fewer than kGroup.
struct EdgeGroup {
  FourPoints start, end, middle, direction;
  Four half;          // m, half the length
  int index[kGroup];  // in the boundary
};

//! Rectangles along the axes.
struct BoxGroup {
  FourPoints lower, upper;
};

//! The edge nearest to a point.
struct NearestEdge {
  int edge = -1;              //!< of several equally near ones, the first in the boundary
  double squared = INFINITY;  //!< [m^2] distance
};

//! How far boxes are at least from a point [m^2].
struct PointBound {
  Four operator()(const BoxGroup& boxes) const {
    const Four u = broadcast(point.u), v = broadcast(point.v);
    const Four beyond_u = larger(larger(boxes.lower.u - u, u - boxes.upper.u), Four{});
    const Four beyond_v = larger(larger(boxes.lower.v - v, v - boxes.upper.v), Four{});
    return beyond_u * beyond_u + beyond_v * beyond_v;
  }

  Point2 point;
};

//! How far boxes are at least from a segment [m^2], by its own box and by the line through it.
struct SegmentBound {
  explicit SegmentBound(const Segment2& s) : segment(s) {
    box.add(s.start);
    box.add(s.end);
  }

  Four operator()(const BoxGroup& boxes) const {
    const Four beyond_u = larger(larger(boxes.lower.u - box.upper.u, box.lower.u - boxes.upper.u), Four{});
    const Four beyond_v = larger(larger(boxes.lower.v - box.upper.v, box.lower.v - boxes.upper.v), Four{});
    const double along_u = segment.direction.u, along_v = segment.direction.v;
    const Four twice_u = boxes.upper.u + boxes.lower.u - 2.0 * segment.middle.u;
    const Four twice_v = boxes.upper.v + boxes.lower.v - 2.0 * segment.middle.v;
    const Four extent =
        std::fabs(along_v) * (boxes.upper.u - boxes.lower.u) + std::fabs(along_u) * (boxes.upper.v - boxes.lower.v);
    const Four aside = 0.5 * larger(absolute(along_u * twice_v - along_v * twice_u) - extent, Four{});
    return larger(beyond_u * beyond_u + beyond_v * beyond_v, aside * aside);
  }

  Segment2 segment;
  Box2 box;
};

//! The edges of a boundary in a tree of boxes, to find those near something.
class EdgeTree {
 public:
  explicit EdgeTree(const PlanarBoundary& boundary);

  //! @param guess an edge that is likely to be near, or any other; the result does not depend on it
  NearestEdge nearest(const Point2& point, int guess) const;

  //! A limit [m^2] for visitNear that rounding cannot make too small for what is as far as `squared` [m^2]
  //! from a point or segment at `place`.
  double limitFor(double squared, const Point2& place) const {
    const double size = normBound(place) + size_;
    return squared * (1.0 + 1e-6) + 1e-22 * size * size;
  }

  //! Calls visit(group) for all groups with an edge within a distance, and others, the nearer boxes first.
  //! @param bound how far boxes are at least: PointBound or SegmentBound
  //! @param limit [m^2] the distance squared, which visit may lower
  template <typename Bound, typename Visit>
  void visitNear(const Bound& bound, const double& limit, Visit&& visit) const;

 private:
  struct Node {
    BoxGroup boxes;     // of the children
    int child[kGroup];  // another node, or -1 - g for group g
    int children = 0;
  };
  struct Waiting {
    int node;
    double squared;
  };

  int build(int* first, int* last);
  int addGroup(const int* first, const int* last);
  Box2 boxOf(const int* first, const int* last) const;
  int* split(int* first, int* last, int groups) const;

  const PlanarBoundary& boundary_;
  const double size_;  // m, of the boundary
  std::vector<Node> nodes_;
  std::vector<EdgeGroup> groups_;
  int root_;
};

template <typename Bound, typename Visit>
void EdgeTree::visitNear(const Bound& bound, const double& limit, Visit&& visit) const {
  Waiting waiting[64];  // three for each level of the tree, which is balanced
  int count = 0;
  waiting[count++] = {root_, 0.0};
  while (count > 0) {
    const Waiting next = waiting[--count];
    if (next.squared > limit) {
      continue;
    }
    if (next.node < 0) {
      visit(groups_[-1 - next.node]);
      continue;
    }
    const Node& node = nodes_[next.node];
    const Four squared = bound(node.boxes);
    const int first = count;
    for (int k = 0; k < node.children; ++k) {
      if (squared[k] <= limit) {
        int place = count++;
        for (; place > first && waiting[place - 1].squared < squared[k]; --place) {
          waiting[place] = waiting[place - 1];
        }
        waiting[place] = {node.child[k], squared[k]};
      }
    }
  }
}

}  // namespace distance
}  // namespace deformable_manipulation
