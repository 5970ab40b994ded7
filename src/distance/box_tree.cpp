#include "box_tree.h"

#include <numeric>

namespace deformable_manipulation {
namespace distance {
namespace {

constexpr int kBins = 16;
constexpr int kLargestDepth = 40;  // of splits by area, from there on in halves

struct Range {
  int begin, end;
  Box box;

  int size() const { return end - begin; }
};

float halfArea(const Box& box) {
  const float x = box.high[0] - box.low[0], y = box.high[1] - box.low[1], z = box.high[2] - box.low[2];
  return x * y + y * z + z * x;
}

class Builder {
 public:
  explicit Builder(const std::vector<Box>& leaves) : leaves_(leaves), order_(leaves.size()) {
    std::iota(order_.begin(), order_.end(), 0);
  }

  BoxTree build() {
    tree_.reserve(leaves_.size() / 2 + 1);
    const Range all = ranged(0, static_cast<int>(leaves_.size()));
    addNode(all, 0);
    return std::move(tree_);
  }

 private:
  Range ranged(int begin, int end) const {
    Range range{begin, end, Box()};
    for (int i = begin; i < end; ++i) {
      range.box.include(leaves_[order_[i]]);
    }
    return range;
  }

  int addNode(const Range& range, int depth) {
    std::array<Range, 4> parts = {range};
    int count = 1;
    while (count < 4) {
      const auto larger = [](const Range& a, const Range& b) { return a.size() < b.size(); };
      Range& largest = *std::max_element(parts.begin(), parts.begin() + count, larger);
      if (largest.size() < 2) {
        break;
      }
      const int middle = split(largest, depth);
      parts[count++] = ranged(middle, largest.end);
      largest = ranged(largest.begin, middle);
    }
    const int index = static_cast<int>(tree_.size());
    tree_.emplace_back();
    for (int slot = 0; slot < count; ++slot) {
      const Range& part = parts[slot];
      const int child = part.size() == 1 ? ~order_[part.begin] : addNode(part, depth + 1);
      tree_[index].set(slot, child, part.box);
    }
    return index;
  }

  //! Reorders a range and returns where its second part starts.
  int split(const Range& range, int depth) {
    Box centres;
    for (int i = range.begin; i < range.end; ++i) {
      const std::array<float, 3> c = centre(order_[i]);
      for (int k = 0; k < 3; ++k) {
        centres.low[k] = std::min(centres.low[k], c[k]);
        centres.high[k] = std::max(centres.high[k], c[k]);
      }
    }
    int axis = 0;
    for (int k = 1; k < 3; ++k) {
      axis = centres.high[k] - centres.low[k] > centres.high[axis] - centres.low[axis] ? k : axis;
    }
    const float low = centres.low[axis], width = centres.high[axis] - low;
    if (range.size() < 5 || depth > kLargestDepth || !(width > 0.0F)) {
      return inHalves(range, axis);
    }
    const float scale = kBins * (1.0F - 1e-6F) / width;
    const auto bin = [&](int leaf) {
      return std::min(kBins - 1, static_cast<int>((centre(leaf)[axis] - low) * scale));
    };
    const int border = bestBorder(range, bin);
    const auto middle = std::partition(order_.begin() + range.begin, order_.begin() + range.end,
                                       [&](int leaf) { return bin(leaf) < border; });
    const int found = static_cast<int>(middle - order_.begin());
    return found > range.begin && found < range.end ? found : inHalves(range, axis);
  }

  std::array<float, 3> centre(int leaf) const {
    const Box& box = leaves_[leaf];
    return {box.low[0] + box.high[0], box.low[1] + box.high[1], box.low[2] + box.high[2]};
  }

  template <typename Bin>
  int bestBorder(const Range& range, const Bin& bin) const {
    std::array<Box, kBins> boxes;
    std::array<int, kBins> counts = {};
    for (int i = range.begin; i < range.end; ++i) {
      const int b = bin(order_[i]);
      boxes[b].include(leaves_[order_[i]]);
      ++counts[b];
    }
    std::array<float, kBins> right = {};
    Box box;
    for (int b = kBins - 1, count = 0; b > 0; --b) {
      box.include(boxes[b]);
      count += counts[b];
      right[b] = count > 0 ? halfArea(box) * count : 0.0F;
    }
    box = Box();
    int best = kBins / 2;
    float least = INFINITY;
    for (int b = 1, count = 0; b < kBins; ++b) {
      box.include(boxes[b - 1]);
      count += counts[b - 1];
      const float cost = (count > 0 ? halfArea(box) * count : 0.0F) + right[b];
      if (count > 0 && count < range.size() && cost < least) {
        least = cost;
        best = b;
      }
    }
    return best;
  }

  int inHalves(const Range& range, int axis) {
    const int middle = range.begin + range.size() / 2;
    std::nth_element(order_.begin() + range.begin, order_.begin() + middle, order_.begin() + range.end,
                     [&](int a, int b) {
                       const float ca = centre(a)[axis], cb = centre(b)[axis];
                       return ca < cb || (ca == cb && a < b);
                     });
    return middle;
  }

  const std::vector<Box>& leaves_;
  std::vector<int> order_;
  BoxTree tree_;
};

}  // namespace

BoxTree buildBoxTree(const std::vector<Box>& leaves) { return Builder(leaves).build(); }

}  // namespace distance
}  // namespace deformable_manipulation
