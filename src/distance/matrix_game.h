#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace deformable_manipulation {
namespace distance {

//! Convex functions on a triangle (or segment) by their values at its corners, and the highest that their minimum can
//! be.
//!
//! On the triangle each convex function is at most the linear interpolation of its corner values, and so is the minimum
//! of all at most the maximum over the triangle of the least interpolation: the value of a matrix game, found by the
//! simplex algorithm.
class MatrixGame {
 public:
  static constexpr int kMostFunctions = 16;

  explicit MatrixGame(int corners) : corners_(corners) {}

  int functions() const { return functions_; }
  bool full() const { return functions_ == kMostFunctions; }

  //! @param at_corners [corners] finite values
  void add(const std::array<double, 3>& at_corners) { values_[functions_++] = at_corners; }

  //! Where the least interpolation is highest, and a bound of it that holds whatever rounding does.
  struct Solution {
    double bound;
    std::array<double, 3> weights;
  };

  Solution solve() const {
    double low = INFINITY, high = -INFINITY;
    for (int f = 0; f < functions_; ++f) {
      for (int v = 0; v < corners_; ++v) {
        low = std::min(low, values_[f][v]);
        high = std::max(high, values_[f][v]);
      }
    }
    const double range = high > low ? high - low : 1.0;
    // Rows: corners, then the objective. Columns: functions, then slacks, then the right-hand side.
    const int columns = functions_ + corners_, right = columns;
    Tableau tableau = {};
    for (int v = 0; v < corners_; ++v) {
      for (int f = 0; f < functions_; ++f) {
        tableau[v][f] = (values_[f][v] - low) / range + 1.0;
      }
      tableau[v][functions_ + v] = tableau[v][right] = 1.0;
    }
    std::fill_n(tableau[corners_].begin(), functions_, -1.0);
    std::array<int, 3> basis = {functions_, functions_ + 1, functions_ + 2};
    for (int pivots = 0; pivots < kMostPivots; ++pivots) {
      const int entering = static_cast<int>(
          std::min_element(tableau[corners_].begin(), tableau[corners_].begin() + columns) - tableau[corners_].begin());
      if (tableau[corners_][entering] >= -kOptimal || !pivot(entering, right, &tableau, &basis)) {
        break;
      }
    }
    return solution(tableau, basis, right);
  }

 private:
  static constexpr int kMostPivots = 40;
  static constexpr double kOptimal = 1e-13;
  using Tableau = std::array<std::array<double, kMostFunctions + 4>, 4>;

  bool pivot(int entering, int right, Tableau* tableau, std::array<int, 3>* basis) const {
    int leaving = -1;
    double least = INFINITY;
    for (int v = 0; v < corners_; ++v) {
      const double entry = (*tableau)[v][entering];
      if (entry > kOptimal && (*tableau)[v][right] / entry < least) {
        least = (*tableau)[v][right] / entry;
        leaving = v;
      }
    }
    if (leaving < 0) {
      return false;
    }
    auto& row = (*tableau)[leaving];
    const double scale = 1.0 / row[entering];
    for (int c = 0; c <= right; ++c) {
      row[c] *= scale;
    }
    for (int r = 0; r <= corners_; ++r) {
      const double factor = (*tableau)[r][entering];
      for (int c = 0; r != leaving && c <= right; ++c) {
        (*tableau)[r][c] -= factor * row[c];
      }
    }
    (*basis)[leaving] = entering;
    return true;
  }

  Solution solution(const Tableau& tableau, const std::array<int, 3>& basis, int right) const {
    Solution solution = {-INFINITY, {0.0, 0.0, 0.0}};
    std::array<double, 3> mixed = {0.0, 0.0, 0.0};
    double shares = 0.0, weights = 0.0;
    for (int v = 0; v < corners_; ++v) {
      const double share = basis[v] < functions_ ? std::max(tableau[v][right], 0.0) : 0.0;
      shares += share;
      for (int k = 0; k < corners_; ++k) {
        mixed[k] += share > 0.0 ? share * values_[basis[v]][k] : 0.0;
      }
      solution.weights[v] = std::max(tableau[corners_][functions_ + v], 0.0);
      weights += solution.weights[v];
    }
    for (int v = 0; v < corners_; ++v) {
      solution.bound = std::max(solution.bound, mixed[v] / shares);
      solution.weights[v] /= weights;
    }
    return solution;
  }

  int corners_;
  int functions_ = 0;
  std::array<std::array<double, 3>, kMostFunctions> values_;
};

}  // namespace distance
}  // namespace deformable_manipulation
