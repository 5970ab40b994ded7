#pragma once

#include <array>
#include <vector>

#include "deformable_manipulation/distance/features.h"

namespace deformable_manipulation {
namespace distance {

//! A trilinear function in a cell of a grid, around a point of it:
//! f(x + d) = value + gradient d + xy dx dy + yz dy dz + zx dz dx + xyz dx dy dz.
struct CellExpansion {
  double value;
  Vector3 gradient;
  double xy, yz, zx, xyz;
};

//! Between what values a function's slopes along the axes are.
struct SlopeRange {
  Vector3 least = Vector3::Constant(INFINITY), most = Vector3::Constant(-INFINITY);
};

//! Numbers on a grid with trilinear interpolation. The grid's first point is the origin.
class DistanceField {
 public:
  using Index = std::array<int, 3>;

  //! @param values [size[0] x size[1] x size[2]] in this order; two at least along each axis
  //! @param spacing [m] of the grid's points along each axis
  DistanceField(std::vector<float> values, const Index& size, const Vector3& spacing);

  //! [m] The corner opposite to the origin.
  const Vector3& extent() const { return extent_; }
  const Vector3& spacing() const { return spacing_; }

  //! No more than this much the function changes per metre.
  double steepness() const { return steepness_; }

  //! The cell of a point; of one outside, the nearest.
  Index cellOf(const Vector3& point) const;

  //! The function of a cell around a point, which may be outside.
  CellExpansion expand(const Index& cell, const Vector3& point) const;

  //! A lower bound of the function in all cells between two of them, by blocks of at least one cell.
  double least(const Index& from, const Index& to) const;

  //! Bounds of its slopes there, by blocks of at least two cells along each axis.
  SlopeRange slopes(const Index& from, const Index& to) const;

 private:
  //! Slopes along an axis.
  struct Slopes {
    float least = INFINITY, most = -INFINITY;
  };

  //! The least numbers, and the slopes, of blocks of cells.
  struct Level {
    Index size;
    std::vector<float> least;
    std::vector<std::array<Slopes, 3>> slopes;

    std::size_t place(int x, int y, int z) const { return (static_cast<std::size_t>(x) * size[1] + y) * size[2] + z; }
  };

  static Level merged(const Level& below, int stride);
  const Level& levelOf(const Index& from, const Index& to, int* shift) const;
  std::vector<std::array<Slopes, 3>> slopesOfCells() const;
  float at(int x, int y, int z) const { return values_[(static_cast<std::size_t>(x) * size_[1] + y) * size_[2] + z]; }

  std::vector<float> values_;  // m
  Index size_;
  std::vector<Level> levels_;  // blocks of 1, 2, 4, ... cells along each axis
  Vector3 spacing_, extent_;   // m
  Vector3 inverse_;            // 1/m, of the spacing
  double steepness_ = 0.0;
};

}  // namespace distance
}  // namespace deformable_manipulation
