#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "deformable_manipulation/distance/obstacle.h"

namespace deformable_manipulation {
namespace distance {

//! A polygon in a plane, endless along the plane's normal.
//!
//! A point's signed distance is its distance to the polygon's boundary, seen along the normal, negative inside. Normals
//! point from the obstacle to the object, inside from the object to the nearest point of the boundary; within 1e-9 m of
//! the boundary they are the edge's outward normal. Triangles of a surface count as filled, seen along the normal.
//!
//! Features of a polyline: the nearest point of each segment; where it is level with an edge, the middle of the nearest
//! stretch. Features of a surface: the nearest point of each triangle, the mean of several if that is as near.
class PlanarObstacle : public Obstacle {
 public:
  //! @param points [m] (a, b), corners of a simple polygon of either orientation, on the obstacle's own axes that
  //!   `plane` names
  //! @param plane "xy", "yz" or "xz"
  //! @param translation [m] and rotation (of length 1): of the obstacle in the fixed frame
  //! @throw std::invalid_argument All reasons: a coordinate is not finite or beyond 1e6 m; there are fewer than
  //!   three distinct points or they bound no area; the polygon crosses itself; the plane is unknown; the pose is
  //!   invalid
  PlanarObstacle(const std::vector<std::array<double, 2>>& points, const std::string& plane,
                 const Vector3& translation = Vector3::Zero(),
                 const pbd::Quaternion& rotation = pbd::Quaternion::Identity());

  //! A region with holes, or of several pieces: a point is in it if an odd number of rings are around it.
  //! @param rings of corners as above, which do not cross or touch one another
  //! @throw std::invalid_argument As above
  PlanarObstacle(const std::vector<std::vector<std::array<double, 2>>>& rings, const std::string& plane,
                 const Vector3& translation = Vector3::Zero(),
                 const pbd::Quaternion& rotation = pbd::Quaternion::Identity());
  ~PlanarObstacle() override;

  void minima(const ObjectView& object, Feature* nearest) override;
  void features(const ObjectView& object, double limit, std::vector<Feature>* found) override;

 private:
  class Search;
  void place(const Vector3& translation, const pbd::Quaternion& rotation, const pbd::Twist& velocity) override;

  std::unique_ptr<Search> search_;
};

}  // namespace distance
}  // namespace deformable_manipulation
