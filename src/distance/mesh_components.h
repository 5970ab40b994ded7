#pragma once

#include <vector>

#include "box_tree.h"
#include "mesh_cleaning.h"

namespace deformable_manipulation {
namespace distance {

//! Triangles connected by edges.
struct MeshComponent {
  std::vector<int> triangles;
  bool closed = true;       // each edge has two triangles, and all can be wound alike
  bool inside_out = false;  // closed and wound alike, but as seen from inside
  int turned = 0;           // triangles that were wound the other way round
  double volume = 0.0;      // m^3
  Box box;
};

//! The components; their triangles are wound alike, and so that a closed one's volume is positive.
std::vector<MeshComponent> windComponents(const std::vector<Vector3>& vertices, std::vector<Triangle>* triangles);

//! Whether a closed component encloses a point, by the solid angle that it fills as seen from there.
bool encloses(const MeshComponent& component, const std::vector<Vector3>& vertices,
              const std::vector<Triangle>& triangles, const Vector3& point);

}  // namespace distance
}  // namespace deformable_manipulation
