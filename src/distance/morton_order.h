#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace deformable_manipulation {
namespace distance {

using FloatPoint = std::array<float, 3>;

//! A point by its index, with its place along a curve.
struct MortonItem {
  std::uint32_t code, point;
};

//! Points in their order along a Morton curve, whose cells become finer where many points are in one.
std::vector<MortonItem> mortonOrder(const std::vector<FloatPoint>& points);

}  // namespace distance
}  // namespace deformable_manipulation
