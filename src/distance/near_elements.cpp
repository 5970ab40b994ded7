#include "deformable_manipulation/distance/near_elements.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "box_tree.h"
#include "search_stack.h"
#include "triangle_geometry.h"

namespace deformable_manipulation {
namespace distance {
namespace {

//! Around all that is within the element's reach.
Box boxOf(const NearElement& element) {
  Box box;
  for (const Vector3& corner : element.corners) {
    box.include(corner - Vector3::Constant(element.reach));
    box.include(corner + Vector3::Constant(element.reach));
  }
  return box;
}

void requireFinite(const NearElement& element) {
  bool finite = std::isfinite(element.reach) && element.reach >= 0.0;
  for (const Vector3& corner : element.corners) {
    finite = finite && corner.allFinite();
  }
  if (!finite) {
    throw std::invalid_argument("an element has a number that is not finite, or a negative reach");
  }
}

}  // namespace

struct NearElements::Tree {
  BoxTree nodes;
};

NearElements::NearElements(std::vector<NearElement> elements) : elements_(std::move(elements)) {
  std::vector<Box> boxes;
  for (const NearElement& element : elements_) {
    requireFinite(element);
    boxes.push_back(boxOf(element));
  }
  if (!boxes.empty()) {
    tree_ = std::make_unique<const Tree>(Tree{buildBoxTree(boxes)});
  }
}

NearElements::~NearElements() = default;

void NearElements::mark(const float* xyz, std::size_t count, bool* marks) const { markAll(xyz, count, marks); }
void NearElements::mark(const double* xyz, std::size_t count, bool* marks) const { markAll(xyz, count, marks); }

template <typename Number>
void NearElements::markAll(const Number* xyz, std::size_t count, bool* marks) const {
  if (tree_ == nullptr) {
    std::fill_n(marks, count, false);
    return;
  }
  const Box& all = tree_->nodes[0].box;
  for (std::size_t i = 0; i < count; ++i) {
    const Number* p = xyz + 3 * i;
    bool inside = true;  // no number is not
    for (int axis = 0; axis < 3; ++axis) {
      inside = inside && p[axis] >= all.low[axis] && p[axis] <= all.high[axis];
    }
    marks[i] = inside && isNear(Vector3(p[0], p[1], p[2]));
  }
}

bool NearElements::isNear(const Vector3& point) const {
  Box box;
  box.include(point);
  SearchStack<int> waiting;
  waiting.push(0.0F, 0);
  while (!waiting.empty()) {
    const BoxNode& node = tree_->nodes[waiting.pop().what];
    const FourFloats away = node.squaredDistances(box);
    for (int slot = 0; slot < 4; ++slot) {
      const int child = node.children[slot];
      if (child == BoxNode::kNone || away[slot] > 0.0F) {
        continue;
      }
      if (child >= 0) {
        waiting.push(0.0F, child);
        continue;
      }
      const NearElement& element = elements_[~child];
      if (nearestOnTriangle(point, element.corners).squared <= element.reach * element.reach) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace distance
}  // namespace deformable_manipulation
