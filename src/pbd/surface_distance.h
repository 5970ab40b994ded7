#pragma once

#include <vector>

#include "fabric_mesh.h"

namespace deformable_manipulation {
namespace pbd {

//! Distances between vertices along an unstretched surface, never too short.
//!
//! On a flat convex mesh they are straight. On others they are the shortest ways along edges and straight across
//! pairs of neighbouring triangles.
class SurfaceDistance {
 public:
  SurfaceDistance(const std::vector<Vector3>& vertices, const std::vector<Triangle>& triangles,
                  const std::vector<MeshEdge>& edges);

  bool straight() const { return straight_; }

  //! [m] Between two vertices of a mesh where distances are straight.
  double straightBetween(int a, int b) const { return (vertices_[a] - vertices_[b]).norm(); }

  //! [N] m, from one vertex to all.
  std::vector<double> from(int vertex) const;

 private:
  struct Way {
    int to;
    double length;  // m
  };

  void addWay(int a, int b, double length);

  std::vector<Vector3> vertices_;
  bool straight_;
  std::vector<std::vector<Way>> ways_;  // from each vertex
};

}  // namespace pbd
}  // namespace deformable_manipulation
