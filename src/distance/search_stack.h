#pragma once

#include <array>
#include <stdexcept>

namespace deformable_manipulation {
namespace distance {

//! What is still to be searched, with lower bounds; the last first.
template <typename What>
class SearchStack {
 public:
  struct Entry {
    float bound;  // [m^2] of the squared distance
    What what;
  };

  bool empty() const { return size_ == 0; }

  void push(float bound, const What& what) {
    if (size_ == static_cast<int>(entries_.size())) {
      throw std::length_error("a tree of boxes is deeper than any of this package's");
    }
    entries_[size_++] = {bound, what};
  }

  Entry pop() { return entries_[--size_]; }

 private:
  std::array<Entry, 512> entries_;  // 3 per level of two trees, 40 splits by area and 20 halvings at most each
  int size_ = 0;
};

}  // namespace distance
}  // namespace deformable_manipulation
