#pragma once

namespace deformable_manipulation {
namespace distance {

constexpr double kLargestCoordinate = 1e6;  // m; beyond it distances lose the precision that safety needs

}  // namespace distance
}  // namespace deformable_manipulation
