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
    inverse_[axis] = 1.0 / spacing[axis];
  }
  levels_.push_back(merged({size_, values_, {}}, 1));
  levels_[0].slopes = slopesOfCells();
  if (levels_[0].least.size() > 1) {
    levels_.push_back(merged(levels_[0], 2));
    levels_[0].slopes = {};  // as much memory as all others have together, and of little use
  }
  while (levels_.back().least.size() > 1) {
    levels_.push_back(merged(levels_.back(), 2));
  }
  for (const Slopes& slopes : levels_.back().slopes[0]) {
    steepness_ = std::hypot(steepness_, std::max(std::fabs(slopes.least), std::fabs(slopes.most)));
  }
}

//! Within a cell, slopes are means of those of its edges.
std::vector<std::array<DistanceField::Slopes, 3>> DistanceField::slopesOfCells() const {
  const Level& cells = levels_[0];
  std::vector<std::array<Slopes, 3>> all(cells.least.size());
  for (std::size_t n = 0; n < all.size(); ++n) {
    const int z = static_cast<int>(n % cells.size[2]), y = static_cast<int>(n / cells.size[2] % cells.size[1]),
              x = static_cast<int>(n / cells.size[2] / cells.size[1]);
    for (int axis = 0; axis < 3; ++axis) {
      const int first = (axis + 1) % 3, second = (axis + 2) % 3;
      for (int edge = 0; edge < 4; ++edge) {
        Index low = {x, y, z};
        low[first] += edge & 1;
        low[second] += edge >> 1;
        Index high = low;
        ++high[axis];
        const float rise = at(high[0], high[1], high[2]) - at(low[0], low[1], low[2]);
        const float slope = rise / static_cast<float>(spacing_[axis]);
        const float rounding = 1e-5F * std::fabs(slope);
        all[n][axis].least = std::min(all[n][axis].least, slope - rounding);
        all[n][axis].most = std::max(all[n][axis].most, slope + rounding);
      }
    }
  }
  return all;
}

//! The least of each eight neighbours.
//! @param stride 1: of any, 2: of those that are together in one block
DistanceField::Level DistanceField::merged(const Level& below, int stride) {
  Level level;
  for (int axis = 0; axis < 3; ++axis) {
    level.size[axis] = stride == 1 ? below.size[axis] - 1 : (below.size[axis] + 1) / 2;
  }
  level.least.assign(level.place(level.size[0] - 1, level.size[1] - 1, level.size[2] - 1) + 1, INFINITY);
  level.slopes.resize(below.slopes.empty() ? 0 : level.least.size());
  for (std::size_t n = 0; n < level.least.size(); ++n) {
    const int z = static_cast<int>(n % level.size[2]), y = static_cast<int>(n / level.size[2] % level.size[1]),
              x = static_cast<int>(n / level.size[2] / level.size[1]);
    for (int corner = 0; corner < 8; ++corner) {
      const std::size_t neighbour = below.place(std::min(stride * x + (corner >> 2), below.size[0] - 1),
                                                std::min(stride * y + (corner >> 1 & 1), below.size[1] - 1),
                                                std::min(stride * z + (corner & 1), below.size[2] - 1));
      level.least[n] = std::min(level.least[n], below.least[neighbour]);
      for (std::size_t axis = 0; axis < 3 && !below.slopes.empty(); ++axis) {
        level.slopes[n][axis].least = std::min(level.slopes[n][axis].least, below.slopes[neighbour][axis].least);
        level.slopes[n][axis].most = std::max(level.slopes[n][axis].most, below.slopes[neighbour][axis].most);
      }
    }
  }
  return level;
}

//! The level whose blocks are so large that not many are between two cells.
const DistanceField::Level& DistanceField::levelOf(const Index& from, const Index& to, int* shift) const {
  const int widest = std::max({to[0] - from[0], to[1] - from[1], to[2] - from[2]});
  while (*shift + 1 < static_cast<int>(levels_.size()) && widest >> *shift > kMostBlocks) {
    ++*shift;
  }
  return levels_[*shift];
}

double DistanceField::least(const Index& from, const Index& to) const {
  int shift = 0;
  const Level& level = levelOf(from, to, &shift);
  float least = INFINITY;
  for (int x = from[0] >> shift; x <= to[0] >> shift; ++x) {
    for (int y = from[1] >> shift; y <= to[1] >> shift; ++y) {
      for (int z = from[2] >> shift; z <= to[2] >> shift; ++z) {
        least = std::min(least, level.least[level.place(x, y, z)]);
      }
    }
  }
  return least;
}

SlopeRange DistanceField::slopes(const Index& from, const Index& to) const {
  int shift = std::min(1, static_cast<int>(levels_.size()) - 1);
  const Level& level = levelOf(from, to, &shift);
  SlopeRange range;
  for (int x = from[0] >> shift; x <= to[0] >> shift; ++x) {
    for (int y = from[1] >> shift; y <= to[1] >> shift; ++y) {
      for (int z = from[2] >> shift; z <= to[2] >> shift; ++z) {
        const std::array<Slopes, 3>& slopes = level.slopes[level.place(x, y, z)];
        for (std::size_t axis = 0; axis < 3; ++axis) {
          range.least[axis] = std::min<double>(range.least[axis], slopes[axis].least);
          range.most[axis] = std::max<double>(range.most[axis], slopes[axis].most);
        }
      }
    }
  }
  return range;
}

}  // namespace distance
}  // namespace deformable_manipulation
