#include "distance_field.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace deformable_manipulation {
namespace distance {

namespace {

constexpr int kMostBlocks = 2;  // along an axis, beside the first

}  // namespace

DistanceField::DistanceField(std::vector<float> values, const Index& size, const Vector3& spacing)
    : values_(std::move(values)), size_(size), spacing_(spacing) {
  for (int axis = 0; axis < 3; ++axis) {
    extent_[axis] = spacing[axis] * (size[axis] - 1);
  }
  steepness_ = steepest();
  levels_.push_back(merged({size_, values_}, 1));
  while (levels_.back().least.size() > 1) {
    levels_.push_back(merged(levels_.back(), 2));
  }
}

//! By the steepest edges of the grid along each axis: within a cell, slopes are means of those of its edges.
double DistanceField::steepest() const {
  const std::array<std::size_t, 3> strides = {static_cast<std::size_t>(size_[1]) * size_[2],
                                              static_cast<std::size_t>(size_[2]), 1};
  Vector3 steepest = Vector3::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    float largest = 0.0F;
    for (std::size_t n = 0; n + strides[axis] < values_.size(); ++n) {
      if (static_cast<int>(n / strides[axis] % size_[axis]) + 1 < size_[axis]) {
        largest = std::max(largest, std::fabs(values_[n + strides[axis]] - values_[n]));
      }
    }
    steepest[axis] = largest / spacing_[axis];
  }
  return steepest.norm();
}

//! The least of each eight neighbours.
//! @param stride 1: of any, 2: of those that are together in one block
DistanceField::Level DistanceField::merged(const Level& below, int stride) {
  Level level;
  for (int axis = 0; axis < 3; ++axis) {
    level.size[axis] = stride == 1 ? below.size[axis] - 1 : (below.size[axis] + 1) / 2;
  }
  level.least.assign(level.place(level.size[0] - 1, level.size[1] - 1, level.size[2] - 1) + 1, INFINITY);
  for (std::size_t n = 0; n < level.least.size(); ++n) {
    const int z = static_cast<int>(n % level.size[2]), y = static_cast<int>(n / level.size[2] % level.size[1]),
              x = static_cast<int>(n / level.size[2] / level.size[1]);
    for (int corner = 0; corner < 8; ++corner) {
      const std::size_t neighbour = below.place(std::min(stride * x + (corner >> 2), below.size[0] - 1),
                                                std::min(stride * y + (corner >> 1 & 1), below.size[1] - 1),
                                                std::min(stride * z + (corner & 1), below.size[2] - 1));
      level.least[n] = std::min(level.least[n], below.least[neighbour]);
    }
  }
  return level;
}

DistanceField::Index DistanceField::cellOf(const Vector3& point) const {
  Index cell;
  for (int axis = 0; axis < 3; ++axis) {
    const double place = std::floor(point[axis] / spacing_[axis]);
    cell[axis] = static_cast<int>(std::min(std::max(place, 0.0), size_[axis] - 2.0));
  }
  return cell;
}

CellExpansion DistanceField::expand(const Index& cell, const Vector3& point) const {
  // Values at the cell's corners become the coefficients of 1, z, y, yz, x, xz, xy, xyz from its lowest corner.
  std::array<double, 8> c;
  for (int corner = 0; corner < 8; ++corner) {
    c[corner] = at(cell[0] + (corner >> 2), cell[1] + (corner >> 1 & 1), cell[2] + (corner & 1));
  }
  for (int axis = 0; axis < 3; ++axis) {
    const int bit = 4 >> axis;
    for (int corner = 0; corner < 8; ++corner) {
      if ((corner & bit) != 0) {
        c[corner] = (c[corner] - c[corner ^ bit]) / spacing_[axis];
      }
    }
  }
  const double x = point.x() - spacing_.x() * cell[0], y = point.y() - spacing_.y() * cell[1],
               z = point.z() - spacing_.z() * cell[2];
  CellExpansion f;
  f.xyz = c[7];
  f.xy = c[6] + c[7] * z;
  f.zx = c[5] + c[7] * y;
  f.yz = c[3] + c[7] * x;
  f.gradient = {c[4] + c[6] * y + c[5] * z + c[7] * y * z, c[2] + c[6] * x + c[3] * z + c[7] * x * z,
                c[1] + c[5] * x + c[3] * y + c[7] * x * y};
  f.value = c[0] + c[4] * x + c[2] * y + c[1] * z + c[6] * x * y + c[5] * x * z + c[3] * y * z + c[7] * x * y * z;
  return f;
}

double DistanceField::least(const Index& from, const Index& to) const {
  const int widest = std::max({to[0] - from[0], to[1] - from[1], to[2] - from[2]});
  std::size_t n = 0;
  while (n + 1 < levels_.size() && widest >> n > kMostBlocks) {
    ++n;
  }
  const Level& level = levels_[n];
  float least = INFINITY;
  for (int x = from[0] >> n; x <= to[0] >> n; ++x) {
    for (int y = from[1] >> n; y <= to[1] >> n; ++y) {
      for (int z = from[2] >> n; z <= to[2] >> n; ++z) {
        least = std::min(least, level.least[level.place(x, y, z)]);
      }
    }
  }
  return least;
}

}  // namespace distance
}  // namespace deformable_manipulation
