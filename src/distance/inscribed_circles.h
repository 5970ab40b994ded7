#pragma once

#include <vector>

#include "planar_region.h"

namespace deformable_manipulation {
namespace distance {

//! A circle in a region that touches its boundary at three places or more.
struct InscribedCircle {
  Point2 centre;
  double radius;  //!< [m] depth of the centre
  int edge;       //!< of the boundary, one that it touches
};

//! Circles around all points of a region that are deeper than all around them, and around the ends of the ridges where
//! the depth is level; some more may be among them. The largest first.
std::vector<InscribedCircle> inscribedCircles(const PlanarRegion& region);

}  // namespace distance
}  // namespace deformable_manipulation
