#include "edge_tree.h"

#include <numeric>

namespace deformable_manipulation {
namespace distance {
namespace {

double coordinate(const Point2& point, bool second) { return second ? point.v : point.u; }

int groupsOf(const int* first, const int* last) { return static_cast<int>((last - first + kGroup - 1) / kGroup); }

}  // namespace

EdgeTree::EdgeTree(const PlanarBoundary& boundary) : boundary_(boundary), size_(norm(boundary.extent().upper)) {
  std::vector<int> order(boundary.size());
  std::iota(order.begin(), order.end(), 0);
  root_ = build(order.data(), order.data() + order.size());
}

//! The tree of some edges, as a node's child.
int EdgeTree::build(int* first, int* last) {
  const int groups = groupsOf(first, last);
  if (groups == 1) {
    return addGroup(first, last);
  }
  // Into halves and again into halves, as far as there are groups.
  int* const middle = split(first, last, groups / 2);
  int* const ends[] = {first, split(first, middle, groupsOf(first, middle) / 2), middle,
                       split(middle, last, groupsOf(middle, last) / 2), last};
  const int index = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  for (int part = 0; part < kGroup; ++part) {
    if (ends[part] < ends[part + 1]) {
      const Box2 box = boxOf(ends[part], ends[part + 1]);
      const int child = build(ends[part], ends[part + 1]);
      Node& node = nodes_[index];
      node.boxes.lower.set(node.children, box.lower);
      node.boxes.upper.set(node.children, box.upper);
      node.child[node.children++] = child;
    }
  }
  return index;
}

//! Sorts some edges so that the first groups are on one side of the others; where those begin.
int* EdgeTree::split(int* first, int* last, int groups) const {
  const Box2 box = boxOf(first, last);
  const bool second = box.upper.v - box.lower.v > box.upper.u - box.lower.u;
  int* const middle = first + groups * kGroup;
  std::nth_element(first, middle, last, [&](int a, int b) {
    return coordinate(boundary_.edge(a).middle, second) < coordinate(boundary_.edge(b).middle, second);
  });
  return middle;
}

Box2 EdgeTree::boxOf(const int* first, const int* last) const {
  Box2 box;
  for (const int* edge = first; edge != last; ++edge) {
    box.add(boundary_.edge(*edge).start);
    box.add(boundary_.edge(*edge).end);
  }
  return box;
}

int EdgeTree::addGroup(const int* first, const int* last) {
  EdgeGroup group;
  for (int k = 0; k < kGroup; ++k) {
    const int index = first[std::min<long>(k, last - first - 1)];
    const Segment2& edge = boundary_.edge(index);
    group.start.set(k, edge.start);
    group.end.set(k, edge.end);
    group.middle.set(k, edge.middle);
    group.direction.set(k, edge.direction);
    group.half.set(k, 0.5 * edge.length);
    group.index[k] = index;
  }
  groups_.push_back(group);
  return -static_cast<int>(groups_.size());
}

NearestEdge EdgeTree::nearest(const Point2& point, int guess) const {
  double limit = limitFor(boundary_.edge(guess).squaredDistance(point), point);
  NearestEdge found;
  visitNear(PointBound{point}, limit, [&](const EdgeGroup& group) {
    const Four arm_u = point.u - group.middle.u, arm_v = point.v - group.middle.v;
    const Four along = group.direction.u * arm_u + group.direction.v * arm_v;
    const Four across = group.direction.u * arm_v - group.direction.v * arm_u;
    const Four beyond = larger(absolute(along) - group.half, Four{});
    const Four squared = beyond * beyond + across * across;
    if (least(squared) > found.squared) {
      return;
    }
    for (int k = 0; k < kGroup; ++k) {
      if (squared[k] < found.squared || (squared[k] == found.squared && group.index[k] < found.edge)) {
        found = {group.index[k], squared[k]};
      }
    }
    limit = std::min(limit, limitFor(found.squared, point));
  });
  return found;
}

}  // namespace distance
}  // namespace deformable_manipulation
