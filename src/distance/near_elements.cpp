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
  bool finite = std::isfinite(element.reach) && element.reach >= 0.0 && !std::isnan(element.farthest);
  for (const Vector3& corner : element.corners) {
    finite = finite && corner.allFinite();
  }
  if (!finite) {
    throw std::invalid_argument("an element has a number that is not finite, or a negative reach");
  }
}

constexpr int kHalvings = 40;  // of a ray's piece, which then is shorter than rounding

//! Whether a point, or one of those up to `doubt` from it either way, is within an element's reach.
//!
//! The squared distance is convex along the way, so that its slope tells where to look on.
bool comesNear(const Vector3& point, const Vector3& doubt, const NearElement& element) {
  double low = -1.0, high = 1.0;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    const Vector3 place = point + middle * doubt;
    const NearestOnTriangle there = nearestOnTriangle(place, element.corners);
    if (i == 0 && there.squared > element.farthest * element.farthest) {
      return false;
    }
    if (there.squared <= element.reach * element.reach) {
      return true;
    }
    if (std::sqrt(there.squared) - 0.5 * (high - low) * doubt.norm() >= element.reach) {
      return false;
    }
    const double slope = doubt.dot(place - weighted<3>(element.corners, there.weights));
    (slope > 0.0 ? high : low) = middle;
  }
  return false;
}

}  // namespace

struct NearElements::Tree {
  BoxTree nodes;
};

NearElements::NearElements(std::vector<NearElement> elements, const Rays& rays)
    : elements_(std::move(elements)), rays_(rays) {
  if (!(rays_.origin.allFinite() && rays_.doubt >= 0.0 && std::isfinite(rays_.doubt))) {
    throw std::invalid_argument("the rays have a number that is not finite, or a negative doubt");
  }
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
    const Vector3 point(xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]);
    const Vector3 ray = point - rays_.origin, doubt = rays_.doubt * ray.norm() * ray;
    bool inside = true;  // no number is not
    for (int axis = 0; axis < 3; ++axis) {
      const double most = std::fabs(doubt[axis]);
      inside = inside && point[axis] + most >= all.low[axis] && point[axis] - most <= all.high[axis];
    }
    marks[i] = inside && isNear(point, doubt);
  }
}

bool NearElements::isNear(const Vector3& point, const Vector3& doubt) const {
  Box box;
  box.include(point - doubt);
  box.include(point + doubt);
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
      if (comesNear(point, doubt, elements_[~child])) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace distance
}  // namespace deformable_manipulation
