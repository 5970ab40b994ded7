#pragma once

#include <array>
#include <string>
#include <vector>

#include "deformable_manipulation/distance/features.h"

namespace deformable_manipulation {
namespace distance {

using Triangle = std::array<int, 3>;

//! Triangles that are searched together.
struct MeshPart {
  std::vector<Vector3> vertices;  // m
  std::vector<Triangle> triangles;
  bool closed = false;   // a closed surface, all triangles wound counter-clockwise as seen from outside
  bool endless = false;  // what is solid is around the surface, not within
};

//! Triangles by the edges they share: neighbours[t][k] is across the edge from corner k to the next one; kBoundary
//! where there is none, kCrowded where there are several.
constexpr int kBoundary = -1;
constexpr int kCrowded = -2;
std::vector<Triangle> edgeNeighbours(const std::vector<Triangle>& triangles, std::size_t vertices);

//! Makes of any triangles what has a defined signed distance.
//!
//! Equal vertices are one. Triangles without area, and repeated ones, are dropped. A component, the triangles connected
//! by edges, is closed if each edge has two triangles and all can be wound alike; it is then wound to enclose its
//! volume from outside, unless it came inside out and lies within another closed one: then it is a cavity of that.
//! Closed components (with their cavities) whose boxes overlap are different parts; all that are not closed are one
//! part.
//!
//! @param problems gets all reasons for which there is no such mesh, and no part is returned
//! @param warnings gets what was changed or cannot be had
std::vector<MeshPart> cleanMesh(const std::vector<Vector3>& vertices, const std::vector<Triangle>& triangles,
                                std::vector<std::string>* problems, std::vector<std::string>* warnings);

}  // namespace distance
}  // namespace deformable_manipulation
