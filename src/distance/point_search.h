#pragma once

#include <memory>
#include <vector>

#include "nearest_pairs.h"
#include "point_tree.h"
#include "search_stack.h"

namespace deformable_manipulation {
namespace distance {

//! A material point of the object and the point of a cloud that is nearest to it.
struct PointPlace {
  double distance = INFINITY;  //!< [m]
  int piece = -1;              //!< the point of the cloud
  int element = -1;            //!< of the object
  Weights weights = {0.0, 0.0, 0.0};

  bool known() const { return element >= 0; }
};

//! Searches the points of a cloud that are nearest to an object.
class PointSearch : private NearestPairs<PointSearch> {
 public:
  explicit PointSearch(std::shared_ptr<const PointTree> tree) : tree_(std::move(tree)) {}

  //! The nearest pair of all.
  //! @param object with the points of one copy
  //! @param guess the pair that was the nearest before, or unknown; for speed only
  //! @param bounds of this copy's elements
  PointPlace minimum(ObjectTree& object, const PointPlace& guess, MovingBounds* bounds);

  //! Appends the nearest pair of each element, where it is not farther apart than `limit` [m].
  void elements(ObjectTree& object, double limit, MovingBounds* bounds, std::vector<PointPlace>* places);

 private:
  friend class NearestPairs<PointSearch>;

  template <int K>
  double search(int element, const Nearest& known, Nearest* nearest);
  void improve(Nearest* pair) const;
  Vector3 towards(const Nearest& pair) const;
  double heightAlong(const Vector3& normal, const HeightRange& range, const Box& box, double squared_reach) const {
    return tree_->heightAlong(normal, range, box, squared_reach);
  }
  void findOthers(int element, const Nearest& nearest);
  MovingBounds::Plane planeOfOthers(const Nearest& nearest);
  static PointPlace placeOf(const Nearest& pair);

  std::shared_ptr<const PointTree> tree_;
  SearchStack<int> stack_;  // nodes, or blocks as ~index
  std::vector<int> rests_;  // [elements] for how many searches other points are not looked at
};

}  // namespace distance
}  // namespace deformable_manipulation
