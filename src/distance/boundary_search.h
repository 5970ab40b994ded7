#pragma once

#include "edge_tree.h"

namespace deformable_manipulation {
namespace distance {

//! Where a segment comes nearest to a boundary.
struct BoundaryApproach {
  double squared = INFINITY;  //!< [m^2] distance, 0 if they cross
  double parameter = 0.0;     //!< of the segment's point
  int edge = -1;              //!< an edge that it is nearest to
};

//! Between which two parameters a segment is about as near as anywhere.
struct Stretch {
  void add(double parameter) {
    low = std::min(low, parameter);
    high = std::max(high, parameter);
  }

  double low = INFINITY, high = -INFINITY;
};

//! How a segment comes nearest to a boundary, if it does within a limit [m^2]. Of several places the first corner's
//! in the boundary counts, then the segment's start.
BoundaryApproach approachBoundary(const EdgeTree& tree, const Segment2& segment, double limit);

//! Where a segment that does not cross the boundary is within a distance [m] of it, its least one: at its ends and
//! opposite corners.
Stretch levelStretch(const EdgeTree& tree, const Segment2& segment, double distance);

}  // namespace distance
}  // namespace deformable_manipulation
