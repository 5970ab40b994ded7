#pragma once

namespace deformable_manipulation {
namespace distance {

//! Four numbers at once, in as many registers as the processor needs.
typedef double Four __attribute__((vector_size(4 * sizeof(double))));

inline Four broadcast(double value) { return Four{value, value, value, value}; }
inline Four larger(const Four& a, const Four& b) { return a > b ? a : b; }
inline Four smaller(const Four& a, const Four& b) { return a < b ? a : b; }
inline Four absolute(const Four& a) { return larger(a, -a); }

//! The least of the four.
inline double least(const Four& a) {
  const double one = a[0] < a[1] ? a[0] : a[1], other = a[2] < a[3] ? a[2] : a[3];
  return one < other ? one : other;
}

}  // namespace distance
}  // namespace deformable_manipulation
