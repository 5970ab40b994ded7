#pragma once

#include <memory>
#include <string>
#include <vector>

#include "deformable_manipulation/distance/obstacle.h"

namespace deformable_manipulation {
namespace distance {

class ConvexShape;

//! A convex solid that is given by numbers.
//!
//! Distances outside, and depths of segments, are exact to rounding; depths of triangles to 1e-9 m. Normals point from
//! the obstacle to the object, inside from the object to the nearest point of the surface.
//!
//! Features: the nearest, or deepest, point of each segment or triangle; of those that are as near, the middle of its
//! edges and corners.
class PrimitiveObstacle : public Obstacle {
 public:
  //! All points on and behind a plane through the obstacle's origin.
  //! @param normal of any length but 0, away from the solid
  //! @throw std::invalid_argument All of these functions, for a size that is not positive and finite
  static std::shared_ptr<PrimitiveObstacle> halfSpace(const Vector3& normal);

  static std::shared_ptr<PrimitiveObstacle> sphere(double radius);

  //! @param size [m] from face to face, along its own axes; its middle is the origin
  static std::shared_ptr<PrimitiveObstacle> box(const Vector3& size);

  //! @param length [m] from end to end, along its own z axis; its middle is the origin
  static std::shared_ptr<PrimitiveObstacle> cylinder(double radius, double length);

  //! All points within the radius from a piece of the z axis, whose middle is the origin.
  //! @param length [m] of that piece: from end to end it is longer by two radii
  static std::shared_ptr<PrimitiveObstacle> capsule(double radius, double length);

  ~PrimitiveObstacle() override;

  void minima(const ObjectView& object, Feature* nearest) override;
  void features(const ObjectView& object, double limit, std::vector<Feature>* found) override;

 private:
  class Search;
  explicit PrimitiveObstacle(std::unique_ptr<const ConvexShape> shape);
  void place(const Vector3& translation, const pbd::Quaternion& rotation, const pbd::Twist& velocity) override;

  std::unique_ptr<Search> search_;
};

}  // namespace distance
}  // namespace deformable_manipulation
