#include "edge_tree.h"

#include <numeric>

namespace deformable_manipulation {
namespace distance {
namespace {

double coordinate(const Point2& point, bool second) { return second ? point.v : point.u; }

}  // namespace

EdgeTree::EdgeTree(const PlanarRing& ring) : ring_(ring), size_(norm(ring.extent().upper)) {
  std::vector<int> order(ring.size());
  std::iota(order.begin(), order.end(), 0);
  nodes_.emplace_back();
  build(0, order.data(), order.data() + order.size());
}

void EdgeTree::build(int node, int* first, int* last) {
  Box2 box;
  for (const int* edge = first; edge != last; ++edge) {
    box.add(ring_.edge(*edge).start);
    box.add(ring_.edge(*edge).end);
  }
  nodes_[node].box = box;
  const int groups = static_cast<int>((last - first + kGroup - 1) / kGroup);
  if (groups == 1) {
    nodes_[node].group = static_cast<int>(groups_.size());
    addGroup(first, last);
    return;
  }
  const bool second = box.upper.v - box.lower.v > box.upper.u - box.lower.u;
  int* middle = first + groups / 2 * kGroup;
  std::nth_element(first, middle, last, [&](int a, int b) {
    return coordinate(ring_.edge(a).middle, second) < coordinate(ring_.edge(b).middle, second);
  });
  const int child = static_cast<int>(nodes_.size());
  nodes_[node].first_child = child;
  nodes_.resize(nodes_.size() + 2);
  build(child, first, middle);
  build(child + 1, middle, last);
}

void EdgeTree::addGroup(const int* first, const int* last) {
  EdgeGroup group;
  for (int k = 0; k < kGroup; ++k) {
    const int index = first[std::min<long>(k, last - first - 1)];
    const Segment2& edge = ring_.edge(index);
    group.start_u[k] = edge.start.u;
    group.start_v[k] = edge.start.v;
    group.end_u[k] = edge.end.u;
    group.end_v[k] = edge.end.v;
    group.middle_u[k] = edge.middle.u;
    group.middle_v[k] = edge.middle.v;
    group.direction_u[k] = edge.direction.u;
    group.direction_v[k] = edge.direction.v;
    group.half[k] = 0.5 * edge.length;
    group.index[k] = index;
  }
  groups_.push_back(group);
}

NearestEdge EdgeTree::nearest(const Point2& point, int guess) const {
  double limit = limitFor(ring_.edge(guess).squaredDistance(point), point);
  NearestEdge found;
  visitNear(PointBound{point}, limit, [&](const EdgeGroup& group) {
    double squared[kGroup];
    for (int k = 0; k < kGroup; ++k) {
      const double arm_u = point.u - group.middle_u[k], arm_v = point.v - group.middle_v[k];
      const double along = group.direction_u[k] * arm_u + group.direction_v[k] * arm_v;
      const double across = group.direction_u[k] * arm_v - group.direction_v[k] * arm_u;
      const double beyond = std::max(std::fabs(along) - group.half[k], 0.0);
      squared[k] = beyond * beyond + across * across;
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
