#pragma once

#include <array>
#include <memory>
#include <vector>

#include "box_tree.h"
#include "four.h"
#include "morton_order.h"

namespace deformable_manipulation {
namespace distance {

//! Eight points side by side.
struct PointBlock {
  static constexpr int kSize = 8;

  std::array<std::array<float, kSize>, 3> xyz;  // m

  Vector3 point(int slot) const { return {xyz[0][slot], xyz[1][slot], xyz[2][slot]}; }
  Four four(int axis, int half) const {
    const float* at = xyz[axis].data() + 4 * half;
    return {Pair{at[0], at[1]}, Pair{at[2], at[3]}};
  }
};

//! Points in a tree of boxes, which is made anew within milliseconds.
//!
//! The points are sorted along a curve that keeps near ones near (Morton, A computer oriented geodetic data base,
//! 1966): eight in a row are a block, four blocks in a row a node, four nodes in a row another one, and so on.
class PointTree {
 public:
  //! @param points [m] one at least, all finite
  explicit PointTree(const std::vector<FloatPoint>& points);

  std::size_t size() const { return size_; }
  const BoxTree& nodes() const { return nodes_; }
  int root() const { return static_cast<int>(nodes_.size()) - 1; }
  const PointBlock& block(int index) const { return blocks_[index]; }

  //! A point by its place in the tree.
  Vector3 point(int piece) const { return blocks_[piece / PointBlock::kSize].point(piece % PointBlock::kSize); }

  //! How far [m] points reach along a unit vector.
  //! @param squared_reach [m^2] points farther than that from the box need not count
  //! @param except the place of a point that does not count, or -1
  double heightAlong(const Vector3& normal, const HeightRange& range, const Box& box, double squared_reach,
                     int except = -1) const;

  std::size_t bytes() const { return nodes_.size() * sizeof(BoxNode) + block_count_ * sizeof(PointBlock); }

 private:
  std::vector<Box> fillBlocks(const std::vector<FloatPoint>& points, const std::vector<MortonItem>& order);
  void addNodes(const std::vector<Box>& boxes);

  std::size_t size_, block_count_;
  std::unique_ptr<PointBlock[]> blocks_;  // the last one repeats its last point
  BoxTree nodes_;                         // children before parents
};

}  // namespace distance
}  // namespace deformable_manipulation
