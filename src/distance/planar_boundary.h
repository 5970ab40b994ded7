#pragma once

#include <array>
#include <string>
#include <vector>

#include "planar_geometry.h"

namespace deformable_manipulation {
namespace distance {

using Corners2 = std::vector<std::array<double, 2>>;  //!< [m] of a ring

//! Closed rings of edges around a region, with the middle of their extent as origin: counterclockwise where the region
//! is within a ring, clockwise around holes. A point is in the region if an odd number of rings are around it.
class PlanarBoundary {
 public:
  //! @param rings of either orientation; repeated corners and a last one equal to the first are dropped
  //! @param problems what is wrong with them is appended; if anything is, the boundary is empty
  PlanarBoundary(const std::vector<Corners2>& rings, std::vector<std::string>* problems);

  int size() const { return static_cast<int>(edges_.size()); }
  const std::vector<Segment2>& edges() const { return edges_; }
  const Segment2& edge(int index) const { return edges_[index]; }

  //! The edges of ring r are those from begins()[r] to before begins()[r + 1]. Each begins where the one before ends.
  const std::vector<int>& begins() const { return begins_; }

  //! The edges of the same ring before and after one.
  int previous(int edge) const { return previous_[edge]; }
  int next(int edge) const { return next_[edge]; }

  //! [m] the boundary's origin in the coordinates of the corners given.
  Point2 origin() const { return origin_; }
  const Box2& extent() const { return extent_; }

  //! Whether a point is inside, told by the edge that it is nearest to.
  bool isInside(const Point2& point, int nearest_edge) const;

  //! The unit vector out of the region at an edge.
  Point2 outwardNormal(int edge) const { return {edges_[edge].direction.v, -edges_[edge].direction.u}; }

 private:
  void addRing(const std::vector<Point2>& corners);

  std::vector<Segment2> edges_;
  std::vector<int> begins_ = {0};
  std::vector<int> previous_, next_;
  Point2 origin_;
  Box2 extent_;
};

}  // namespace distance
}  // namespace deformable_manipulation
