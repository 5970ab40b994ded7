#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "deformable_manipulation/pbd/types.h"

namespace deformable_manipulation {
namespace distance {

using pbd::Vector3;

//! A nearest pair of points of the object and an obstacle, in the fixed frame.
//!
//! The object point is a material point: the sum over k of weights[k] times geometry point
//! vertices[k]; unused ones have weight 0.
struct Feature {
  double distance = 0.0;                        //!< [m] signed: positive outside, negative: depth inside
  int obstacle = -1;                            //!< index of the obstacle
  Vector3 object_point = Vector3::Zero();       //!< [m] on the centre line or mid-surface
  Vector3 obstacle_point = Vector3::Zero();     //!< [m] on the obstacle's surface
  Vector3 normal = Vector3::Zero();             //!< unit vector along which the distance grows fastest
  Vector3 obstacle_velocity = Vector3::Zero();  //!< [m/s] of the obstacle at its point
  std::array<int, 3> vertices = {0, 0, 0};
  std::array<double, 3> weights = {0.0, 0.0, 0.0};  //!< not negative, sum 1
  std::int64_t identity = -1;                       //!< of obstacle and element, the same from call to call; -1: none
};

//! Features of C copies of an object; those of copy c are features[offsets[c]] to
//! features[offsets[c + 1] - 1], the nearest first.
struct Distances {
  std::vector<double> minimum;  //!< [C] m; infinite if there is no obstacle
  std::vector<int> offsets;     //!< [C + 1]
  std::vector<Feature> features;
};

//! All copies of an object at one instant: polylines, or surfaces of triangles.
struct ObjectView {
  const double* points = nullptr;  //!< [copies x point_count x 3] m
  int copies = 0;
  int point_count = 0;
  const std::array<int, 3>* triangles = nullptr;  //!< null: a polyline through the points in their order
  int triangle_count = 0;

  //! Segments, or triangles.
  int elements() const { return triangles == nullptr ? point_count - 1 : triangle_count; }
  int cornersOfElement() const { return triangles == nullptr ? 2 : 3; }

  //! Geometry points of an element; those of a segment: start, end, end.
  std::array<int, 3> element(int index) const {
    return triangles == nullptr ? std::array<int, 3>{index, index + 1, index + 1} : triangles[index];
  }

  Vector3 point(int copy, int index) const {
    const double* at = points + 3 * (static_cast<long>(copy) * point_count + index);
    return {at[0], at[1], at[2]};
  }
};

}  // namespace distance
}  // namespace deformable_manipulation
