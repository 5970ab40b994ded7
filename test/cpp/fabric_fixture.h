#pragma once

#include <memory>

#include "deformable_manipulation/pbd/fabric.h"
#include "rod_fixture.h"
#include "settling.h"

namespace deformable_manipulation {
namespace pbd {

//! A rectangle of columns x rows vertices, row by row along x.
inline FabricParameters sheet(int columns, int rows, double spacing) {
  FabricParameters p;
  p.density = 1.0;
  p.thickness = 0.001;
  p.stretching_compliance = 1e-4;
  p.damping = 10.0;
  p.gravity = {0.0, 0.0, -9.81};
  p.bending_compliance = 1e3;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      p.vertices.emplace_back(spacing * i, spacing * j, 0.0);
    }
  }
  for (int j = 0; j + 1 < rows; ++j) {
    for (int i = 0; i + 1 < columns; ++i) {
      const int a = j * columns + i;
      p.triangles.push_back({a, a + 1, a + columns + 1});
      p.triangles.push_back({a, a + columns + 1, a + columns});
    }
  }
  return p;
}

//! The paper's fabric: 2 m x 2 m, 15 x 15 particles.
inline FabricParameters cloth() { return sheet(15, 15, 2.0 / 14.0); }

//! A fabric held at some particles, which come together to a part of their distances.
inline std::unique_ptr<Fabric> hangingFabric(const FabricParameters& p, const std::vector<int>& held, double part) {
  auto fabric = std::make_unique<Fabric>(p);
  for (int particle : held) {
    fabric->hold(particle, Hold::PINNED, {part * p.vertices[particle], Quaternion::Identity()});
  }
  fabric->layOut();
  return fabric;
}

inline std::unique_ptr<Fabric> hangingCloth(const FabricParameters& p) {
  return hangingFabric(p, {0, 14, 210, 224}, 0.9);
}

inline SettleOptions smallSubsteps() { return settling(10); }

}  // namespace pbd
}  // namespace deformable_manipulation
