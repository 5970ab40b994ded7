#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "deformable_manipulation/distance/features.h"

namespace deformable_manipulation {
namespace distance {

//! An axis-aligned box, rounded outwards to single precision.
struct Box {
  std::array<float, 3> low = {INFINITY, INFINITY, INFINITY};
  std::array<float, 3> high = {-INFINITY, -INFINITY, -INFINITY};

  void include(const Vector3& point) {
    for (int k = 0; k < 3; ++k) {
      const float value = static_cast<float>(point[k]);
      // As far as rounding to the nearest can be off, and a bit.
      const float error = std::fabs(value) * 1.2e-7F + 1e-36F;
      low[k] = std::min(low[k], value - error);
      high[k] = std::max(high[k], value + error);
    }
  }

  void include(const Box& other) {
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], other.low[k]);
      high[k] = std::max(high[k], other.high[k]);
    }
  }

  //! Sum of the sides [m].
  float extent() const { return high[0] - low[0] + high[1] - low[1] + high[2] - low[2]; }

  Vector3 middle() const {
    return {0.5 * (double(low[0]) + high[0]), 0.5 * (double(low[1]) + high[1]), 0.5 * (double(low[2]) + high[2])};
  }

  Vector3 halfSides() const {
    return {0.5 * (double(high[0]) - low[0]), 0.5 * (double(high[1]) - low[1]), 0.5 * (double(high[2]) - low[2])};
  }

  bool overlaps(const Box& other) const {
    for (int k = 0; k < 3; ++k) {
      if (low[k] > other.high[k] || high[k] < other.low[k]) {
        return false;
      }
    }
    return true;
  }
};

template <std::size_t N>
Box boxAround(const std::array<Vector3, N>& points) {
  Box box;
  for (const Vector3& point : points) {
    box.include(point);
  }
  return box;
}

//! Four numbers of single precision in one register.
typedef float FourFloats __attribute__((vector_size(4 * sizeof(float))));

inline FourFloats larger(const FourFloats& a, const FourFloats& b) { return a > b ? a : b; }
inline bool anyBelow(const FourFloats& a, double limit) {
  return a[0] < limit || a[1] < limit || a[2] < limit || a[3] < limit;
}
inline FourFloats absolute(const FourFloats& a) { return larger(a, -a); }

//! A node's four children, their boxes side by side. A child is a node (0 or more), a leaf (~index), or none.
struct BoxNode {
  static constexpr int kNone = 0x7fffffff;

  std::array<FourFloats, 3> low, high;
  std::array<int, 4> children = {kNone, kNone, kNone, kNone};
  Box box;  // around all

  BoxNode() {
    low.fill(FourFloats{INFINITY, INFINITY, INFINITY, INFINITY});
    high.fill(-low[0]);
  }

  void set(int slot, int child, const Box& of_child) {
    children[slot] = child;
    setBox(slot, of_child);
    box.include(of_child);
  }

  void setBox(int slot, const Box& of_child) {
    for (int k = 0; k < 3; ++k) {
      low[k][slot] = of_child.low[k];
      high[k][slot] = of_child.high[k];
    }
  }

  Box childBox(int slot) const {
    Box of_child;
    for (int k = 0; k < 3; ++k) {
      of_child.low[k] = low[k][slot];
      of_child.high[k] = high[k][slot];
    }
    return of_child;
  }

  //! Lower bounds [m^2] of the squared distances between another box and the children's; infinite if there is none.
  FourFloats squaredDistances(const Box& other) const {
    FourFloats sum = {};
    for (int k = 0; k < 3; ++k) {
      const FourFloats below = low[k] - other.high[k], above = other.low[k] - high[k];
      FourFloats gap = larger(below, above);
      gap = gap > 0.0F ? gap : FourFloats{};
      sum += gap * gap;
    }
    return sum * (1.0F - 1e-6F);  // rounding
  }

  //! Upper bounds [m] of how far the children reach along a unit vector; not a number where there is none.
  FourFloats heightsAlong(const Eigen::Vector3f& normal) const {
    FourFloats sum = {}, size = {};
    for (int k = 0; k < 3; ++k) {
      const FourFloats highest = normal[k] * (normal[k] > 0.0F ? high[k] : low[k]);
      sum += highest;
      size += absolute(highest);
    }
    return sum + 1e-6F * size;  // rounding
  }
};

//! Which heights [m] are of interest.
struct HeightRange {
  double lowest = -INFINITY;  //!< no result is less
  double enough = INFINITY;   //!< what is higher counts as infinite
};

//! A tree of boxes with four children a node; node 0 is the root.
using BoxTree = std::vector<BoxNode>;

//! Over boxes of leaves, split where the surface area heuristic is least.
BoxTree buildBoxTree(const std::vector<Box>& leaves);

//! The children of a node in the order of rough bounds, the farthest first; those whose bounds are not below the limit
//! are left out.
class NearChildren {
 public:
  NearChildren(const FourFloats& rough, const FourFloats& bounds, double limit) {
    for (int slot = 0; slot < 4; ++slot) {
      if (bounds[slot] < limit) {
        int at = count_++;
        for (; at > 0 && rough[slots_[at - 1]] < rough[slot]; --at) {
          slots_[at] = slots_[at - 1];
        }
        slots_[at] = slot;
      } else {
        least_left_out_ = std::min(least_left_out_, bounds[slot]);
      }
    }
  }

  int count() const { return count_; }
  int slot(int i) const { return slots_[i]; }
  float leastLeftOut() const { return least_left_out_; }

 private:
  std::array<int, 4> slots_;
  float least_left_out_ = INFINITY;
  int count_ = 0;
};

}  // namespace distance
}  // namespace deformable_manipulation
