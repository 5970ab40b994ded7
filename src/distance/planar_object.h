#pragma once

#include <array>
#include <vector>

#include "planar_region.h"

namespace deformable_manipulation {
namespace distance {

//! A material point of the object: its geometry points' weighted sum.
struct MaterialPoint {
  double distance = INFINITY;  //!< [m] signed
  int edge = 0;                //!< of the boundary, near there; a guess only
  std::array<int, 3> vertices = {0, 0, 0};
  std::array<double, 3> weights = {0.0, 0.0, 0.0};
};

//! One copy of the object in the plane of the obstacle.
struct PlanarCopy {
  const Point2* points;
  int count;

  Point2 at(const MaterialPoint& place) const {
    return place.weights[0] * points[place.vertices[0]] + place.weights[1] * points[place.vertices[1]] +
           place.weights[2] * points[place.vertices[2]];
  }
};

}  // namespace distance
}  // namespace deformable_manipulation
