#pragma once

namespace deformable_manipulation {
namespace distance {

//! Two numbers in one register; processors without such registers work on them one by one.
typedef double Pair __attribute__((vector_size(2 * sizeof(double))));

//! Four numbers at once.
struct Four {
  double operator[](int k) const { return k < 2 ? low[k] : high[k - 2]; }
  void set(int k, double value) {
    if (k < 2) {
      low[k] = value;
    } else {
      high[k - 2] = value;
    }
  }

  Pair low = {}, high = {};
};

inline Four broadcast(double value) { return {Pair{value, value}, Pair{value, value}}; }
inline Four operator+(const Four& a, const Four& b) { return {a.low + b.low, a.high + b.high}; }
inline Four operator-(const Four& a, const Four& b) { return {a.low - b.low, a.high - b.high}; }
inline Four operator*(const Four& a, const Four& b) { return {a.low * b.low, a.high * b.high}; }
inline Four operator/(const Four& a, const Four& b) { return {a.low / b.low, a.high / b.high}; }
inline Four operator-(double a, const Four& b) { return {a - b.low, a - b.high}; }
inline Four operator-(const Four& a, double b) { return {a.low - b, a.high - b}; }
inline Four operator*(double a, const Four& b) { return {a * b.low, a * b.high}; }

inline Pair larger(const Pair& a, const Pair& b) { return a > b ? a : b; }
inline Pair smaller(const Pair& a, const Pair& b) { return a < b ? a : b; }
inline Four larger(const Four& a, const Four& b) { return {larger(a.low, b.low), larger(a.high, b.high)}; }
inline Four smaller(const Four& a, const Four& b) { return {smaller(a.low, b.low), smaller(a.high, b.high)}; }
inline Four absolute(const Four& a) { return {larger(a.low, -a.low), larger(a.high, -a.high)}; }

//! Of each number the one from `a` where `left` is above `right`, elsewhere the one from `b`.
inline Four whereAbove(const Four& left, const Four& right, const Four& a, const Four& b) {
  return {left.low > right.low ? a.low : b.low, left.high > right.high ? a.high : b.high};
}

//! The least of the four.
inline double least(const Four& a) {
  const Pair both = smaller(a.low, a.high);
  return both[0] < both[1] ? both[0] : both[1];
}

}  // namespace distance
}  // namespace deformable_manipulation
