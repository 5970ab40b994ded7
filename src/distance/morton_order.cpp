#include "morton_order.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace deformable_manipulation {
namespace distance {
namespace {

constexpr int kBits = 10;             // of each axis
constexpr std::size_t kCrowded = 32;  // points in a cell that are sorted among themselves
constexpr std::size_t kFew = 1000;    // points that are sorted faster without counting
constexpr int kDeepest = 8;           // times a cell is divided: then its sides are below the precision of numbers

//! The lowest ten bits, each followed by two zeros.
std::uint32_t spread(std::uint32_t value) {
  value = (value | (value << 16)) & 0x030000FFU;
  value = (value | (value << 8)) & 0x0300F00FU;
  value = (value | (value << 4)) & 0x030C30C3U;
  return (value | (value << 2)) & 0x09249249U;
}

class Sorter {
 public:
  explicit Sorter(const std::vector<FloatPoint>& points)
      : points_(points), items_(points.size()), spare_(points.size()) {
    for (std::size_t i = 0; i < items_.size(); ++i) {
      items_[i].point = static_cast<std::uint32_t>(i);
    }
  }

  std::vector<MortonItem> order() {
    sort(0, items_.size(), 0);
    return std::move(items_);
  }

 private:
  void sort(std::size_t begin, std::size_t end, int depth) {
    if (!encode(begin, end)) {
      return;  // all at one place
    }
    sortByCode(begin, end);
    for (std::size_t first = begin, last; first < end && depth < kDeepest; first = last) {
      last = first + 1;
      while (last < end && items_[last].code == items_[first].code) {
        ++last;
      }
      if (last - first > kCrowded) {
        sort(first, last, depth + 1);
      }
    }
  }

  bool encode(std::size_t begin, std::size_t end) {
    FloatPoint low, high;
    low.fill(INFINITY);
    high.fill(-INFINITY);
    for (std::size_t i = begin; i < end; ++i) {
      const FloatPoint& point = points_[items_[i].point];
      for (int axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], point[axis]);
        high[axis] = std::max(high[axis], point[axis]);
      }
    }
    const float side = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
    if (!(side > std::numeric_limits<float>::min())) {
      return false;
    }
    const float cells = ((1 << kBits) - 0.5F) / side;
    for (std::size_t i = begin; i < end; ++i) {
      const FloatPoint& point = points_[items_[i].point];
      items_[i].code = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const auto cell = static_cast<std::int32_t>(cells * (point[axis] - low[axis]));
        items_[i].code |= spread(static_cast<std::uint32_t>(cell)) << axis;
      }
    }
    return true;
  }

  void sortByCode(std::size_t begin, std::size_t end) {
    if (end - begin < kFew) {
      std::sort(items_.begin() + begin, items_.begin() + end, [](const MortonItem& a, const MortonItem& b) {
        return a.code < b.code || (a.code == b.code && a.point < b.point);
      });
      return;
    }
    constexpr int kDigits = 3, kValues = 1 << kBits;
    std::array<std::array<std::uint32_t, kValues>, kDigits> starts = {};
    for (std::size_t i = begin; i < end; ++i) {
      for (int digit = 0; digit < kDigits; ++digit) {
        ++starts[digit][(items_[i].code >> (kBits * digit)) % kValues];
      }
    }
    MortonItem *from = items_.data(), *to = spare_.data();
    for (int digit = 0; digit < kDigits; ++digit, std::swap(from, to)) {
      std::uint32_t sum = static_cast<std::uint32_t>(begin);
      for (std::uint32_t& start : starts[digit]) {
        const std::uint32_t count = start;
        start = sum;
        sum += count;
      }
      for (std::size_t i = begin; i < end; ++i) {
        to[starts[digit][(from[i].code >> (kBits * digit)) % kValues]++] = from[i];
      }
    }
    if (end - begin == items_.size()) {
      items_.swap(spare_);  // an odd number of times
    } else {
      std::copy(from + begin, from + end, items_.begin() + begin);
    }
  }

  const std::vector<FloatPoint>& points_;
  std::vector<MortonItem> items_, spare_;
};

}  // namespace

std::vector<MortonItem> mortonOrder(const std::vector<FloatPoint>& points) { return Sorter(points).order(); }

}  // namespace distance
}  // namespace deformable_manipulation
