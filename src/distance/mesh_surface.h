#pragma once

#include <array>
#include <vector>

#include "box_tree.h"
#include "disc_tree.h"
#include "mesh_cleaning.h"
#include "triangle_geometry.h"

namespace deformable_manipulation {
namespace distance {

//! The point of a surface that is nearest to another point.
struct SurfacePoint {
  double distance = INFINITY;  //!< [m] signed; not negative for a surface that is not closed
  int triangle = -1;
  Weights weights = {0.0, 0.0, 0.0};
};

//! A surface of triangles with a tree of boxes.
class MeshSurface {
 public:
  explicit MeshSurface(const MeshPart& part);

  bool closed() const { return closed_; }
  bool endless() const { return endless_; }
  const BoxTree& tree() const { return tree_; }
  const DiscNode& discs(int node) const { return discs_[node]; }
  const Box& box() const { return tree_[0].box; }

  Corners<3> corners(int triangle) const {
    const Triangle& t = triangles_[triangle];
    return {vertices_[t[0]], vertices_[t[1]], vertices_[t[2]]};
  }

  //! @param hint a triangle probably near, or -1; for speed only
  //! @param enough [m] a place not farther than this will do, though it may not be the nearest
  SurfacePoint nearest(const Vector3& point, int hint = -1, double enough = -1.0) const;

  //! How far [m] triangles reach along a unit vector.
  //! @param squared_reach [m^2] triangles farther than that from the box need not count
  double heightAlong(const Vector3& normal, const HeightRange& range, const Box& box, double squared_reach) const;

  //! The distance [m] of a point to one of the triangles.
  double distanceTo(int triangle, const Vector3& point) const {
    return std::sqrt(nearestOnTriangle(point, corners(triangle)).squared);
  }

  //! The distance [m] of a point to the plane of one of the triangles.
  double distanceToPlane(int triangle, const Vector3& point) const {
    return std::fabs(unitNormal(triangle).dot(point - corners(triangle)[0]));
  }

  Vector3 position(const SurfacePoint& place) const { return weighted<3>(corners(place.triangle), place.weights); }

  //! The outward normal (of any length) with whose side of the surface every point is that has its nearest point here:
  //! the angle-weighted mean of the normals around (Baerentzen and Aanaes, Signed distance computation using the angle
  //! weighted pseudonormal, 2005). Of a surface that is not closed, the triangle's normal.
  Vector3 pseudonormal(const SurfacePoint& place) const;

 private:
  void sortLikeTree();
  void sumCornerNormals();
  Vector3 unitNormal(int triangle) const {
    const Corners<3> c = corners(triangle);
    return (c[1] - c[0]).cross(c[2] - c[0]).normalized();
  }

  std::vector<Vector3> vertices_;  // m
  std::vector<Triangle> triangles_;
  bool closed_, endless_;
  BoxTree tree_;
  std::vector<DiscNode> discs_;
  std::vector<Triangle> neighbours_;             // of closed ones only
  std::vector<Eigen::Vector3f> corner_normals_;  // [vertices] of closed ones only
};

}  // namespace distance
}  // namespace deformable_manipulation
