#pragma once

// Arrays of quantities of several copies: [item][component][lane].

#include "aligned_array.h"
#include "deformable_manipulation/pbd/types.h"

namespace deformable_manipulation {
namespace pbd {

//! Copies that advance together: one SIMD lane each.
constexpr int kLanes = 8;

inline void copyLane(AlignedArray& to_array, int to, const AlignedArray& from_array, int from) {
  for (std::size_t i = 0; i < to_array.size(); i += kLanes) {
    to_array[i + to] = from_array[i + from];
  }
}

inline Vector3 read3(const AlignedArray& array, int item, int lane) {
  const double* at = array.data() + 3 * kLanes * item + lane;
  return {at[0], at[kLanes], at[2 * kLanes]};
}

inline void write3(AlignedArray& array, int item, int lane, const Vector3& value) {
  for (int axis = 0; axis < 3; ++axis) {
    array[(3 * item + axis) * kLanes + lane] = value[axis];
  }
}

//! Everything of one lane, in order.
inline void unpack(const AlignedArray& array, int lane, double* to) {
  for (std::size_t i = lane, end = array.size(); i < end; i += kLanes) {
    *to++ = array[i];
  }
}

}  // namespace pbd
}  // namespace deformable_manipulation
