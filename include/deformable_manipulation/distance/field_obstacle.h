#pragma once

#include <array>
#include <memory>
#include <vector>

#include "deformable_manipulation/distance/obstacle.h"

namespace deformable_manipulation {
namespace distance {

//! Signed distances on a grid, interpolated trilinearly.
//!
//! The least one over a segment or triangle is exact to 1e-5 m. Normals are along the field's gradient; where that is
//! zero, along the obstacle's z axis. The obstacle's point lies at the field's distance along the normal.
//!
//! Outside of the grid nothing is known. As free space, it has no obstacle but those in the grid: distances there are
//! lower bounds of those. As occupied space, it is an obstacle with the grid's border as its surface.
//!
//! Features: the nearest, or deepest, point of each segment or triangle; the mean of its corners, if they are as near.
class FieldObstacle : public Obstacle {
 public:
  //! @param values [m] at origin + spacing * (i, j, k), at the place (i * size[1] + j) * size[2] + k
  //! @param size how many there are along each of the obstacle's axes, two at least
  //! @param spacing [m] along each axis
  //! @throw std::invalid_argument All reasons: another number of values, or one that is not finite; sizes below two;
  //!   a spacing or an origin that is not finite, too small or too large
  FieldObstacle(std::vector<float> values, const std::array<int, 3>& size, const Vector3& origin,
                const Vector3& spacing, bool is_free_outside);
  ~FieldObstacle() override;

  //! The same field at the same place, for another thread; its values are shared.
  std::shared_ptr<FieldObstacle> another() const;

  void minima(const ObjectView& object, Feature* nearest) override;
  void features(const ObjectView& object, double limit, std::vector<Feature>* found) override;

 private:
  class Search;
  explicit FieldObstacle(std::unique_ptr<Search> search);
  void place(const Vector3& translation, const pbd::Quaternion& rotation, const pbd::Twist& velocity) override;

  std::unique_ptr<Search> search_;
};

}  // namespace distance
}  // namespace deformable_manipulation
