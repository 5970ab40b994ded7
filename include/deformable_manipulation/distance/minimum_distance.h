#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "deformable_manipulation/distance/obstacle.h"

namespace deformable_manipulation {
namespace distance {

//! Signed minimum distances between all copies of an object and several obstacles, from surface to
//! surface. Obstacles are treated one by one: where two overlap, the depth is that in one of them.
class MinimumDistance {
 public:
  //! @param margin [m] from the object's centre line or mid-surface to its surface: radius or half thickness
  //! @param band [m] features of copy 0 up to this much farther than its minimum are reported
  //! @throw std::invalid_argument if a length is negative or not finite
  MinimumDistance(std::vector<std::shared_ptr<Obstacle>> obstacles, double margin, double band);

  //! Another obstacle in the place of one, from the next computation on.
  //! @throw std::invalid_argument there is no such place, or the obstacle is null
  void replace(std::size_t index, std::shared_ptr<Obstacle> obstacle);

  //! Copy 0 gets all its features within the band, every other copy only that of its minimum.
  //! It depends only on the arguments. The result is valid until the next call.
  //! @throw std::invalid_argument if there is no copy, a copy has fewer than two points, a triangle refers to
  //! a point that does not exist, or a coordinate is not finite or beyond 1e6 m.
  const Distances& compute(const ObjectView& object);

 private:
  void addFeatures(const ObjectView& object);

  std::vector<std::shared_ptr<Obstacle>> obstacles_;
  double margin_;
  double band_;
  Distances result_;
  std::vector<Feature> nearest_;  // [copies] over the obstacles so far
  std::vector<Feature> of_one_;   // [copies] of one obstacle
};

}  // namespace distance
}  // namespace deformable_manipulation
