#pragma once

#include <Eigen/Core>
#include <vector>

namespace deformable_manipulation {
namespace control {

//! Constraints coefficients . u >= bound on a velocity u of any number of components.
//!
//! Each row is of a kind: with L barriers, 0 to L - 1 are their limits, in the team's order, and L is anticipation:
//! wishes rather than limits, which always yield first. The rows of a kind share one slack, see
//! SafetyFilter.
//!
//! Its memory is reused from one cycle to the next.
class ConstraintRows {
 public:
  using Coefficients = Eigen::Map<const Eigen::VectorXd>;

  //! Removes all rows; sets the number of components of the velocities.
  void clear(int components) {
    components_ = components;
    kinds_.clear();
    bounds_.clear();
    coefficients_.clear();
  }

  //! Adds a row.
  //! @param bound [m/s]
  //! @return its coefficients [components], zeros to be filled in before the next row is added
  Eigen::Map<Eigen::VectorXd> add(int kind, double bound) {
    kinds_.push_back(kind);
    bounds_.push_back(bound);
    coefficients_.resize(coefficients_.size() + components_, 0.0);
    return {coefficients_.data() + (size() - 1) * components_, components_};
  }

  int size() const { return static_cast<int>(kinds_.size()); }
  int components() const { return components_; }
  int kind(int row) const { return kinds_[row]; }
  double bound(int row) const { return bounds_[row]; }
  Coefficients coefficients(int row) const { return {coefficients_.data() + row * components_, components_}; }

 private:
  int components_ = 0;
  std::vector<int> kinds_;
  std::vector<double> bounds_;
  std::vector<double> coefficients_;  // [rows x components]
};

}  // namespace control
}  // namespace deformable_manipulation
