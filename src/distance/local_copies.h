#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "object_tree.h"

namespace deformable_manipulation {
namespace distance {

//! All copies of an object in the frame of an obstacle.
class LocalCopies {
 public:
  //! Takes the object's elements and makes room for its copies.
  //! @return whether the elements are others than before: nothing that is known of them holds any more
  bool prepare(const ObjectView& object) {
    const bool others = object_.setElements(object);
    if (others) {
      points_.clear();
    }
    while (static_cast<int>(points_.size()) < object.copies) {
      points_.emplace_back(object.point_count, Vector3::Zero());
    }
    return others;
  }

  int count() const { return static_cast<int>(points_.size()); }

  //! Takes a copy into the obstacle's frame.
  //! @return how far [m] any of its points has moved there since the last call
  template <typename ToLocal>
  double bring(const ObjectView& object, int copy, const ToLocal& to_local) {
    double squared_step = 0.0;
    for (int i = 0; i < object.point_count; ++i) {
      Vector3& point = points_[copy][i];
      const Vector3 before = point;
      point = to_local(object.point(copy, i));
      squared_step = std::max(squared_step, (point - before).squaredNorm());
    }
    object_.setPoints(points_[copy]);
    return std::sqrt(squared_step);
  }

  //! With the points of the copy that was brought last.
  ObjectTree& object() { return object_; }

 private:
  ObjectTree object_;
  std::vector<std::vector<Vector3>> points_;  // m
};

}  // namespace distance
}  // namespace deformable_manipulation
