#pragma once

#include <array>
#include <string>
#include <vector>

#include "planar_geometry.h"

namespace deformable_manipulation {
namespace distance {

//! A closed ring of edges around a region, counterclockwise, with the middle of its extent as origin.
//! Edge i leads from corner i to corner i + 1.
class PlanarRing {
 public:
  //! @param points [m] corners of either orientation; repeated ones and a last one equal to the first are dropped
  //! @param problems what is wrong with them is appended; if anything is, the ring is empty
  PlanarRing(const std::vector<std::array<double, 2>>& points, std::vector<std::string>* problems);

  int size() const { return static_cast<int>(edges_.size()); }
  const std::vector<Segment2>& edges() const { return edges_; }
  const Segment2& edge(int index) const { return edges_[index]; }

  //! [m] the ring's origin in the coordinates of the points given.
  Point2 origin() const { return origin_; }
  const Box2& extent() const { return extent_; }

  //! Whether a point is inside, told by the edge that it is nearest to.
  bool isInside(const Point2& point, int nearest_edge) const;

  //! The unit vector out of the region at an edge.
  Point2 outwardNormal(int edge) const { return {edges_[edge].direction.v, -edges_[edge].direction.u}; }

 private:
  std::vector<Segment2> edges_;
  Point2 origin_;
  Box2 extent_;
};

}  // namespace distance
}  // namespace deformable_manipulation
