#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "deformable_manipulation/distance/obstacle.h"

namespace deformable_manipulation {
namespace distance {

//! The surface of any number of triangles.
//!
//! Vertices at the same place are one. A component is a set of triangles connected by edges. It is a solid if it is
//! closed: each edge has two triangles, which can be wound consistently. Its volume decides which side is inside, not
//! its winding. The only exception is a component wound inwards within another solid, which is a cavity of that. A
//! point's signed distance is its distance to the surface, negative inside a solid. Solids are treated one by one:
//! where two overlap, the depth is that in one of them, not in their union. A solid that crosses itself has the sign of
//! the piece of its surface that is nearest. Components that are not closed have distances without a sign, 0 where the
//! object crosses.
//!
//! Distances are exact to rounding outside. Depths inside are the greatest to within a thousandth and 1e-7 m, at most
//! 1e-5 m; the reported points always have the reported distance. Normals point from the obstacle to the object, inside
//! from the object to the nearest point of the surface; within 1e-9 m of the surface they are its outward normal (of a
//! surface that is not closed, that of the triangle).
//!
//! Features: the nearest, or deepest, point of each segment or triangle. Where corners of it are as near as that, their
//! mean, if it is as near, too.
class MeshObstacle : public Obstacle {
 public:
  //! @param vertices [m] in the obstacle's own frame
  //! @param triangles indices of vertices, of either orientation
  //! @param translation [m] and rotation (of length 1): of the obstacle in the fixed frame
  //! @throw std::invalid_argument All reasons: there is no triangle with an area; a vertex is not finite or
  //!   beyond 1e6 m; a triangle refers to a vertex that does not exist; the pose is invalid
  MeshObstacle(const std::vector<Vector3>& vertices, const std::vector<std::array<int, 3>>& triangles,
               const Vector3& translation = Vector3::Zero(),
               const pbd::Quaternion& rotation = pbd::Quaternion::Identity());
  //! The surface of cubes side by side, which is one solid.
  //! @param cells indices (i, j, k) of cubes, at most 1048574; cube (i, j, k) has the corners size (i, j, k) and
  //!   size (i + 1, j + 1, k + 1)
  //! @param size [m] of a cube
  //! @param endless these cubes are free, and all else is solid
  //! @throw std::invalid_argument All reasons: there is no cube; a cube is too far away; the size is not positive
  static std::shared_ptr<MeshObstacle> ofCells(const std::vector<std::array<int, 3>>& cells, double size,
                                               bool endless = false);
  ~MeshObstacle() override;

  //! The same shape at the same place, for another thread; its surface is shared.
  std::shared_ptr<MeshObstacle> another() const;

  //! Sentences about what was dropped or turned, and what has no sign.
  const std::vector<std::string>& warnings() const { return warnings_; }

  void minima(const ObjectView& object, Feature* nearest) override;
  void features(const ObjectView& object, double limit, std::vector<Feature>* found) override;

 private:
  class Search;
  explicit MeshObstacle(std::unique_ptr<Search> search);
  void place(const Vector3& translation, const pbd::Quaternion& rotation, const pbd::Twist& velocity) override;

  std::vector<std::string> warnings_;
  std::unique_ptr<Search> search_;
};

}  // namespace distance
}  // namespace deformable_manipulation
