#include "deformable_manipulation/control/dual_active_set.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace deformable_manipulation {
namespace control {

namespace {

constexpr double INFINITE = std::numeric_limits<double>::infinity();

// A violation below this, relative to the size of the numbers that make it, is rounding.
constexpr double ROUNDING = 1e-12;

// A unit normal whose part across the active ones is shorter counts as their combination.
constexpr double DEPENDENT = 1e-8;

// Taken in and dropped constraints per variable and row: some ten times what was ever seen to be needed.
constexpr int ITERATIONS_PER_VARIABLE = 20;
constexpr int ITERATIONS_PER_ROW = 2;

}  // namespace

DualActiveSet::Outcome DualActiveSet::solve(const QuadraticProgram& program) {
  iterations_ = 0;
  if (!scale(program)) {
    return Outcome::UNSOLVED;
  }
  const int most = ITERATIONS_PER_VARIABLE * n_ + ITERATIONS_PER_ROW * rows_;
  int entering = mostViolated();
  double multiplier = 0.0;
  while (entering >= 0) {
    if (++iterations_ > most) {
      return Outcome::UNSOLVED;
    }
    const Step taken = step(entering, multiplier);
    if (taken == Step::IMPOSSIBLE) {
      return Outcome::INFEASIBLE;
    }
    if (taken == Step::TAKEN_IN) {
      entering = mostViolated();
      multiplier = 0.0;
    }
  }
  solution_ = y_.cwiseQuotient(root_);
  return solution_.allFinite() ? Outcome::OPTIMAL : Outcome::UNSOLVED;
}

//! The program in y, with normals of unit length, and the start; false if a number is not finite.
bool DualActiveSet::scale(const QuadraticProgram& program) {
  n_ = program.variables();
  rows_ = program.rows;
  root_ = program.hessian.cwiseSqrt();
  y_ = -program.linear.cwiseQuotient(root_);
  if (normals_.rows() < rows_ || normals_.cols() != n_) {
    normals_.resize(std::max<Eigen::Index>(rows_, normals_.rows()), n_);
    levels_.resize(normals_.rows());
  }
  double largest = 0.0;
  for (int row = 0; row < rows_; ++row) {
    normals_.row(row) = program.constraints.row(row).cwiseQuotient(root_.transpose());
    const double length = normals_.row(row).norm();
    const double scale = length > 0.0 ? 1.0 / length : 1.0;
    normals_.row(row) *= scale;
    levels_[row] = scale * program.limits[row];
    largest = std::max(largest, std::abs(levels_[row]));
    if (!std::isfinite(length) || !std::isfinite(levels_[row])) {
      return false;
    }
  }
  tolerance_ = ROUNDING * (1.0 + largest);
  Q_.setIdentity(n_, n_);
  R_.resize(n_, n_);
  for (Eigen::VectorXd* vector : {&d_, &direction_, &reduction_, &multipliers_}) {
    vector->resize(n_);
  }
  active_.clear();
  is_active_.assign(static_cast<std::size_t>(rows_), 0);
  return y_.allFinite();
}

//! The row that y is farthest beyond, or -1 if all hold.
int DualActiveSet::mostViolated() const {
  const double tolerance = tolerance_ + ROUNDING * y_.cwiseAbs().maxCoeff();
  double worst = -tolerance;
  int found = -1;
  for (int row = 0; row < rows_; ++row) {
    const double margin = normals_.row(row).dot(y_) - levels_[row];
    if (margin < worst && !is_active_[row]) {
      worst = margin;
      found = row;
    }
  }
  return found;
}

//! Raises the entering constraint's multiplier until it holds or an active one has to go.
DualActiveSet::Step DualActiveSet::step(int entering, double& multiplier) {
  const int count = static_cast<int>(active_.size());
  d_.noalias() = Q_.transpose() * normals_.row(entering).transpose();
  reduction_.head(count) = R_.topLeftCorner(count, count).triangularView<Eigen::Upper>().solve(d_.head(count));
  const double across = d_.tail(n_ - count).squaredNorm();
  const bool dependent = across <= DEPENDENT * DEPENDENT;
  double partial = INFINITE;
  const int blocking = firstToBlock(partial);
  double full = INFINITE;
  if (!dependent) {
    full = std::max(0.0, levels_[entering] - normals_.row(entering).dot(y_)) / across;
  }
  const double length = std::min(partial, full);
  if (length == INFINITE) {
    return Step::IMPOSSIBLE;
  }
  if (!dependent) {
    direction_.noalias() = Q_.rightCols(n_ - count) * d_.tail(n_ - count);
    y_ += length * direction_;
  }
  multipliers_.head(count) -= length * reduction_.head(count);
  multiplier += length;
  if (full <= partial) {
    takeIn(entering, multiplier);
    return Step::TAKEN_IN;
  }
  drop(blocking);
  return Step::DROPPED;
}

//! Which active constraint's multiplier is the first to vanish, and after what length; -1: none.
int DualActiveSet::firstToBlock(double& length) const {
  int found = -1;
  for (std::size_t place = 0; place < active_.size(); ++place) {
    if (reduction_[place] > ROUNDING) {
      const double own = std::max(0.0, multipliers_[place]) / reduction_[place];
      if (own < length) {
        length = own;
        found = static_cast<int>(place);
      }
    }
  }
  return found;
}

//! Turns columns first and first + 1 of Q so that (a, b) becomes (hypot(a, b), 0).
void DualActiveSet::rotate(int first, double a, double b) {
  const double size = std::hypot(a, b);
  const double c = a / size;
  const double s = b / size;
  for (int i = 0; i < n_; ++i) {
    const double p = Q_(i, first);
    const double q = Q_(i, first + 1);
    Q_(i, first) = c * p + s * q;
    Q_(i, first + 1) = c * q - s * p;
  }
  for (int k = first + 1; k < static_cast<int>(active_.size()); ++k) {
    const double p = R_(first, k);
    const double q = R_(first + 1, k);
    R_(first, k) = c * p + s * q;
    R_(first + 1, k) = c * q - s * p;
  }
}

//! Appends the normal whose Q' n is in d to the factorisation.
void DualActiveSet::takeIn(int row, double multiplier) {
  const int count = static_cast<int>(active_.size());
  for (int i = n_ - 2; i >= count; --i) {
    if (d_[i + 1] != 0.0) {
      rotate(i, d_[i], d_[i + 1]);
      d_[i] = std::hypot(d_[i], d_[i + 1]);
    }
  }
  R_.col(count).head(count + 1) = d_.head(count + 1);
  multipliers_[count] = multiplier;
  active_.push_back(row);
  is_active_[row] = 1;
}

//! Takes an active normal out of the factorisation: R loses a column and is made triangular again.
void DualActiveSet::drop(int place) {
  is_active_[active_[place]] = 0;
  const int last = static_cast<int>(active_.size()) - 1;
  for (int k = place; k < last; ++k) {
    R_.col(k).head(k + 2) = R_.col(k + 1).head(k + 2);
    multipliers_[k] = multipliers_[k + 1];
  }
  active_.erase(active_.begin() + place);
  for (int k = place; k < last; ++k) {
    const double a = R_(k, k);
    const double b = R_(k + 1, k);
    rotate(k, a, b);
    R_(k, k) = std::hypot(a, b);
  }
}

}  // namespace control
}  // namespace deformable_manipulation
