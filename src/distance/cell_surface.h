#pragma once

#include <array>
#include <vector>

#include "mesh_cleaning.h"

namespace deformable_manipulation {
namespace distance {

using Cell = std::array<int, 3>;

constexpr int kLargestCell = (1 << 20) - 2;  // of each index, to both sides

//! The surface between cubes that are filled and all that are not; closed, with two triangles at each edge.
//!
//! Where two cubes share no more than an edge, that is two edges at one place: the solid goes through.
//! @param cells indices of cubes, at most kLargestCell; cube (i, j, k) has the corners size (i, j, k) and
//!   size (i + 1, j + 1, k + 1). One at least; repeated ones are one
//! @param size [m] of a cube
//! @param endless these cubes are the ones that are not filled, and all others are
MeshPart surfaceOfCells(const std::vector<Cell>& cells, double size, bool endless);

}  // namespace distance
}  // namespace deformable_manipulation
