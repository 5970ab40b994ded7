#pragma once

#include <array>
#include <vector>

namespace deformable_manipulation {

//! What of an object is needed to draw it from its geometry points.
struct ObjectShape {
  double thickness = 0.0;                     //!< [m] of a fabric; diameter of a rod
  std::vector<std::array<int, 3>> triangles;  //!< of points of a fabric; a rod has none
};

}  // namespace deformable_manipulation
