#include "point_tree.h"

#include <algorithm>
#include <cmath>

#include "search_stack.h"

namespace deformable_manipulation {
namespace distance {

namespace {

constexpr std::size_t kAhead = 24;  // points to be fetched from memory in good time

}  // namespace

PointTree::PointTree(const std::vector<FloatPoint>& points)
    : size_(points.size()),
      block_count_((points.size() + PointBlock::kSize - 1) / PointBlock::kSize),
      blocks_(new PointBlock[block_count_]) {
  addNodes(fillBlocks(points, mortonOrder(points)));
}

std::vector<Box> PointTree::fillBlocks(const std::vector<FloatPoint>& points, const std::vector<MortonItem>& order) {
  std::vector<Box> boxes(block_count_);
  const std::size_t last = points.size() - 1;
  for (std::size_t b = 0; b < block_count_; ++b) {
    for (int slot = 0; slot < PointBlock::kSize; ++slot) {
      const std::size_t place = PointBlock::kSize * b + slot;
      __builtin_prefetch(&points[order[std::min(place + kAhead, last)].point]);
      const FloatPoint& point = points[order[std::min(place, last)].point];
      for (int axis = 0; axis < 3; ++axis) {
        blocks_[b].xyz[axis][slot] = point[axis];
        boxes[b].low[axis] = std::min(boxes[b].low[axis], point[axis]);
        boxes[b].high[axis] = std::max(boxes[b].high[axis], point[axis]);
      }
    }
  }
  return boxes;
}

void PointTree::addNodes(const std::vector<Box>& boxes) {
  nodes_.reserve(boxes.size() / 3 + 40);
  std::size_t first = 0, count = (boxes.size() + 3) / 4;
  for (std::size_t n = 0; n < count; ++n) {
    nodes_.emplace_back();
    for (std::size_t b = 4 * n; b < std::min(4 * n + 4, boxes.size()); ++b) {
      nodes_.back().set(static_cast<int>(b % 4), ~static_cast<int>(b), boxes[b]);
    }
  }
  while (count > 1) {
    const std::size_t end = first + count, parents = (count + 3) / 4;
    for (std::size_t n = 0; n < parents; ++n) {
      nodes_.emplace_back();
      for (std::size_t child = first + 4 * n; child < std::min(first + 4 * n + 4, end); ++child) {
        nodes_.back().set(static_cast<int>((child - first) % 4), static_cast<int>(child), nodes_[child].box);
      }
    }
    first = end;
    count = parents;
  }
}

double PointTree::heightAlong(const Vector3& normal, const HeightRange& range, const Box& box, double squared_reach,
                              int except) const {
  double highest = range.lowest;
  const Eigen::Vector3f along = normal.cast<float>();
  SearchStack<int> stack;
  stack.push(INFINITY, root());
  while (!stack.empty() && highest <= range.enough) {
    const SearchStack<int>::Entry entry = stack.pop();
    if (entry.bound <= highest) {
      continue;
    }
    if (entry.what < 0) {
      const PointBlock& eight = block(~entry.what);
      for (int slot = 0; slot < PointBlock::kSize; ++slot) {
        if (PointBlock::kSize * ~entry.what + slot != except) {
          highest = std::max(highest, normal.dot(eight.point(slot)));
        }
      }
      continue;
    }
    const BoxNode& node = nodes_[entry.what];
    const FourFloats away = node.squaredDistances(box), heights = node.heightsAlong(along);
    for (int slot = 0; slot < 4; ++slot) {
      if (node.children[slot] != BoxNode::kNone && away[slot] <= squared_reach && heights[slot] > highest) {
        stack.push(heights[slot], node.children[slot]);
      }
    }
  }
  return highest > range.enough ? INFINITY : highest;
}

}  // namespace distance
}  // namespace deformable_manipulation
