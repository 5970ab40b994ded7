#pragma once

#include <array>
#include <vector>

#include "deformable_manipulation/pbd/fabric_parameters.h"

namespace deformable_manipulation {
namespace pbd {

//! An edge of a triangle mesh with its one or two triangles.
struct MeshEdge {
  std::array<int, 2> vertices;   // the smaller one first
  std::array<int, 2> triangles;  // the second one -1 on the boundary
  std::array<int, 2> opposite;   // the vertex of each triangle that is not on the edge, or -1
  double length;                 // m
  double area;                   // m^2, of its triangles

  bool interior() const { return triangles[1] >= 0; }
};

double triangleArea(const std::vector<Vector3>& vertices, const Triangle& triangle);

//! The edges of a mesh that checkMesh() accepts, sorted by their vertices.
std::vector<MeshEdge> meshEdges(const std::vector<Vector3>& vertices, const std::vector<Triangle>& triangles);

//! Weights of the four points of an interior edge, vertices first, whose sum C has the length 2 |e| sin(angle / 2)
//! for an edge of length |e| folded by an angle, and is zero if it is flat (Bergou et al. 2006).
std::array<double, 4> foldWeights(const std::vector<Vector3>& vertices, const MeshEdge& edge);

//! Notes what is wrong with a mesh: vertices that are not finite or not used, triangles without area or given twice,
//! edges of three triangles, several pieces.
void checkMesh(const std::vector<Vector3>& vertices, const std::vector<Triangle>& triangles, ParameterCheck& check);

}  // namespace pbd
}  // namespace deformable_manipulation
