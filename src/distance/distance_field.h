#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
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
  Index cellOf(const Vector3& point) const {
    Index cell;
    for (int axis = 0; axis < 3; ++axis) {
      // Not below 0, so that what is behind the point is cut off downwards.
      cell[axis] = static_cast<int>(std::min(std::max(point[axis] * inverse_[axis], 0.0), size_[axis] - 2.0));
    }
    return cell;
  }

  //! The function of a cell around a point, which may be outside.
  CellExpansion expand(const Index& cell, const Vector3& point) const {
    const std::array<double, 8> c = coefficients(cell);
    const Vector3 d = fromLowestCorner(cell, point);
    CellExpansion f;
    f.xyz = c[7];
    f.xy = c[6] + c[7] * d.z();
    f.zx = c[5] + c[7] * d.y();
    f.yz = c[3] + c[7] * d.x();
    f.gradient = {c[4] + c[6] * d.y() + c[5] * d.z() + c[7] * d.y() * d.z(),
                  c[2] + c[6] * d.x() + c[3] * d.z() + c[7] * d.x() * d.z(),
                  c[1] + c[5] * d.x() + c[3] * d.y() + c[7] * d.x() * d.y()};
    f.value = valueAt(c, d);
    return f;
  }

  //! Its value alone.
  double value(const Index& cell, const Vector3& point) const {
    return valueAt(coefficients(cell), fromLowestCorner(cell, point));
  }

  //! A lower bound of the function in all cells between two of them, by blocks of at least one cell.
  double least(const Index& from, const Index& to) const;

  //! Bounds of its slopes there, by blocks of at least two cells along each axis.
  SlopeRange slopes(const Index& from, const Index& to) const;

 private:
  //! Of 1, z, y, yz, x, xz, xy, xyz from the lowest corner of a cell: from the values at its corners.
  std::array<double, 8> coefficients(const Index& cell) const {
    const std::size_t row = size_[2], layer = row * size_[1];
    const float* lowest = values_.data() + cell[0] * layer + cell[1] * row + cell[2];
    std::array<double, 8> c = {lowest[0],     lowest[1],         lowest[row],         lowest[row + 1],
                               lowest[layer], lowest[layer + 1], lowest[layer + row], lowest[layer + row + 1]};
    for (int axis = 0; axis < 3; ++axis) {
      const int bit = 4 >> axis;
      for (int corner = 0; corner < 8; ++corner) {
        if ((corner & bit) != 0) {
          c[corner] = (c[corner] - c[corner ^ bit]) * inverse_[axis];
        }
      }
    }
    return c;
  }

  Vector3 fromLowestCorner(const Index& cell, const Vector3& point) const {
    return {point.x() - spacing_.x() * cell[0], point.y() - spacing_.y() * cell[1], point.z() - spacing_.z() * cell[2]};
  }

  static double valueAt(const std::array<double, 8>& c, const Vector3& d) {
    return c[0] + c[4] * d.x() + c[2] * d.y() + c[1] * d.z() + c[6] * d.x() * d.y() + c[5] * d.x() * d.z() +
           c[3] * d.y() * d.z() + c[7] * d.x() * d.y() * d.z();
  }

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
