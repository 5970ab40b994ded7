#pragma once

#include <Eigen/Core>
#include <vector>

namespace deformable_manipulation {
namespace control {

//! Kinds of constraints. Each kind shares one slack; see SafetyFilter for which of them yields first.
enum class Tier {
  COLLISION,
  OVERSTRETCH,
  PROXIMITY,
  ANTICIPATION  //!< wishes for later rather than limits: always the first to yield
};
constexpr int TIERS = 4;
constexpr int LIMIT_TIERS = 3;  //!< those that are limits

//! Constraints coefficients . u >= bound on a velocity u of any number of components.
//!
//! Keeps its memory from one cycle to the next.
class ConstraintRows {
 public:
  using Coefficients = Eigen::Map<const Eigen::VectorXd>;

  //! Starts afresh, for velocities of so many components.
  void clear(int components) {
    components_ = components;
    tiers_.clear();
    bounds_.clear();
    coefficients_.clear();
  }

  //! Adds a row.
  //! @param bound [m/s]
  //! @return its coefficients [components], zeros to be filled in before the next row is added
  Eigen::Map<Eigen::VectorXd> add(Tier tier, double bound) {
    tiers_.push_back(tier);
    bounds_.push_back(bound);
    coefficients_.resize(coefficients_.size() + components_, 0.0);
    return {coefficients_.data() + (size() - 1) * components_, components_};
  }

  int size() const { return static_cast<int>(tiers_.size()); }
  int components() const { return components_; }
  Tier tier(int row) const { return tiers_[row]; }
  double bound(int row) const { return bounds_[row]; }
  Coefficients coefficients(int row) const { return {coefficients_.data() + row * components_, components_}; }

 private:
  int components_ = 0;
  std::vector<Tier> tiers_;
  std::vector<double> bounds_;
  std::vector<double> coefficients_;  // [rows x components]
};

}  // namespace control
}  // namespace deformable_manipulation
