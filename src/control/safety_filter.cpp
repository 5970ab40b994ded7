#include "deformable_manipulation/control/safety_filter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace deformable_manipulation {
namespace control {

namespace {

// A row whose coefficients sum to less asks for more than the agent can give: at 0.15 m/s it changes its
// barrier by less than 0.15 mm/s, about what differences between copies resolve. It is left out of the
// program and shows in the slack alone.
constexpr double NEGLIGIBLE_GRADIENT = 1e-3;

// Cost of one m/s of slack, in multiples of the steepest cost of departing from the nominal velocity, as powers of ten:
// of the first limit in the priority and of the last.
constexpr double FIRST_PENALTY = 6.0;
constexpr double LAST_PENALTY = 2.0;

// A row yields at least this part of what the others of its limit do: the penalties stay apart.
constexpr double LEAST_YIELDING = 0.1;

std::vector<double> penaltiesOf(const Priority& priority) {
  const int limits = static_cast<int>(priority.size());
  std::vector<double> penalties(priority.size() + 1, 0.0);
  for (int place = 0; place < limits; ++place) {
    const int limit = priority[place];
    if (limit < 0 || limit >= limits || penalties[limit] != 0.0) {
      throw std::invalid_argument("priority must name each limit once");
    }
    const double step = (FIRST_PENALTY - LAST_PENALTY) / std::max(1, limits - 1);
    penalties[limit] = std::pow(10.0, FIRST_PENALTY - step * place);
  }
  return penalties;
}

}  // namespace

SafetyFilter::SafetyFilter(const Eigen::VectorXd& weights, const Priority& priority, bool relaxation)
    : penalties_(penaltiesOf(priority)), relaxation_(relaxation) {
  setWeights(weights);
  solver_ = [this](const QuadraticProgram& program, Eigen::VectorXd& x) {
    if (native_.solve(program) != DualActiveSet::Outcome::OPTIMAL) {
      return false;
    }
    x = native_.solution();
    return true;
  };
}

void SafetyFilter::setWeights(const Eigen::VectorXd& weights) {
  if (weights.size() == 0 || !weights.allFinite() || !(weights.array() > 0.0).all()) {
    throw std::invalid_argument("controller.weights must be positive finite numbers");
  }
  squares_ = (weights / weights.maxCoeff()).cwiseAbs2();
}

const Filtered& SafetyFilter::filter(const Eigen::VectorXd& nominal, const ConstraintRows& rows,
                                     const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
  const Eigen::Index n = squares_.size();
  if (nominal.size() != n || lower.size() != n || upper.size() != n || (rows.size() && rows.components() != n)) {
    throw std::invalid_argument("nominal, lower, upper and rows must have as many components as there are weights");
  }
  result_.rows = rows.size();
  result_.rows_act = false;
  result_.slack.assign(penalties_.size(), 0.0);
  result_.status = decide({nominal, rows, lower, upper});
  if (result_.status == Status::FAILED) {
    result_.velocity = Eigen::VectorXd::Zero(n);
    result_.slack.assign(penalties_.size(), 0.0);
  }
  return result_;
}

Status SafetyFilter::decide(const Given& given) {
  if (!given.nominal.allFinite() || !given.lower.allFinite() || !given.upper.allFinite() ||
      (given.lower.array() > given.upper.array()).any()) {
    return Status::FAILED;
  }
  for (int row = 0; row < given.rows.size(); ++row) {
    if (given.rows.kind(row) < 0 || given.rows.kind(row) >= kinds()) {
      throw std::invalid_argument("a row has a kind that the filter does not know");
    }
    // A sum is finite only if all terms are.
    if (!std::isfinite(given.rows.coefficients(row).sum() + given.rows.bound(row))) {
      return Status::FAILED;
    }
  }
  // With a diagonal cost, clipping is the optimum over the bounds alone, and so the optimum altogether if it
  // satisfies the rows.
  result_.velocity = given.nominal.cwiseMax(given.lower).cwiseMin(given.upper);
  result_.rows_act = !holds(given);
  if (result_.rows_act) {
    if (!solve(given)) {
      return Status::FAILED;
    }
    if (measureSlack(given)) {
      return Status::RELAXED;
    }
  }
  const double departure = (result_.velocity - given.nominal).cwiseAbs().maxCoeff();
  return departure > VELOCITY_TOLERANCE ? Status::CONSTRAINED : Status::NOMINAL;
}

//! Whether the velocity satisfies all rows.
bool SafetyFilter::holds(const Given& given) const {
  for (int row = 0; row < given.rows.size(); ++row) {
    if (!(given.rows.coefficients(row).dot(result_.velocity) >= given.rows.bound(row))) {
      return false;
    }
  }
  return true;
}

void SafetyFilter::formulate(const Given& given) {
  const Eigen::Index n = squares_.size();
  const Eigen::Index slacks = relaxation_ ? kinds() : 0;
  program_.hessian.resize(n + slacks);
  program_.linear.resize(n + slacks);
  program_.hessian.head(n) = squares_;
  program_.linear.head(n) = -squares_.cwiseProduct(given.nominal);
  program_.clear(given.rows.size() + static_cast<int>(2 * n + slacks));
  if (relaxation_) {
    const auto reach = given.lower.cwiseAbs().cwiseMax(given.upper.cwiseAbs());
    const double steepest = (squares_.array() * (given.nominal.cwiseAbs() + reach).array()).maxCoeff();
    for (int kind = 0; kind < kinds(); ++kind) {
      program_.hessian[n + kind] = isLimit(kind) ? 1.0 : anticipation_;
      program_.linear[n + kind] = penalties_[kind] * (steepest > 0.0 ? steepest : 1.0);
      program_.addRow(0.0)[n + kind] = 1.0;
    }
  }
  if (relaxation_) {
    measureDemands(given);
  }
  for (int row = 0; row < given.rows.size(); ++row) {
    addRow(given, row);
  }
  addBounds(given);
}

//! What each row demands beyond the middle of the bounds, in multiples of what they allow: up to -1 every velocity
//! satisfies it, beyond 1 none does.
void SafetyFilter::measureDemands(const Given& given) {
  demands_.resize(static_cast<std::size_t>(given.rows.size()));
  for (int row = 0; row < given.rows.size(); ++row) {
    const ConstraintRows::Coefficients g = given.rows.coefficients(row);
    const double middle = 0.5 * g.dot(given.lower + given.upper);
    const double reach = 0.5 * g.cwiseAbs().dot(given.upper - given.lower);
    demands_[row] = (given.rows.bound(row) - middle) / std::max(reach, std::numeric_limits<double>::min());
  }
}

//! The part of its limit's slack that a row yields: less than one if it is out of reach and another one of less demand
//! pulls against it.
double SafetyFilter::yielding(const Given& given, int row) const {
  const ConstraintRows::Coefficients g = given.rows.coefficients(row);
  double part = 1.0;
  if (!isLimit(given.rows.kind(row)) || !(demands_[row] > 1.0)) {
    return part;
  }
  for (int other = 0; other < given.rows.size(); ++other) {
    if (given.rows.kind(other) != given.rows.kind(row) || !(demands_[other] > -1.0)) {
      continue;
    }
    const ConstraintRows::Coefficients h = given.rows.coefficients(other);
    const double against = std::max(0.0, -g.dot(h)) / std::max(g.norm() * h.norm(), NEGLIGIBLE_GRADIENT);
    const double excess = std::max(0.0, 1.0 - std::max(1.0, demands_[other]) / demands_[row]);
    part = std::min(part, 1.0 - against * excess);
  }
  return std::max(part, LEAST_YIELDING);
}

//! A row of the barriers, as far as it can be satisfied and missed within the bounds.
void SafetyFilter::addRow(const Given& given, int row) {
  const ConstraintRows::Coefficients g = given.rows.coefficients(row);
  double limit = given.rows.bound(row);
  if (relaxation_) {
    const double most = g.cwiseMax(0.0).dot(given.upper) + g.cwiseMin(0.0).dot(given.lower);
    const double least = g.cwiseMax(0.0).dot(given.lower) + g.cwiseMin(0.0).dot(given.upper);
    if (limit <= least || g.lpNorm<1>() < NEGLIGIBLE_GRADIENT) {
      return;
    }
    limit = std::min(limit, most);
  }
  auto added = program_.addRow(limit);
  added.head(g.size()) = g.transpose();
  if (relaxation_) {
    added[g.size() + given.rows.kind(row)] = yielding(given, row);
  }
}

void SafetyFilter::addBounds(const Given& given) {
  for (Eigen::Index i = 0; i < squares_.size(); ++i) {
    program_.addRow(given.lower[i])[i] = 1.0;
    program_.addRow(-given.upper[i])[i] = -1.0;
  }
}

//! The velocity that solves the program; false if there is none that is valid.
bool SafetyFilter::solve(const Given& given) {
  formulate(given);
  if (!solver_(program_, solution_) || !isValid()) {
    return false;
  }
  // Without the rounding at the bounds.
  result_.velocity = solution_.head(squares_.size()).cwiseMax(given.lower).cwiseMin(given.upper);
  return true;
}

//! Whether the solution is finite and satisfies the program.
bool SafetyFilter::isValid() const {
  if (solution_.size() != program_.variables() || !solution_.allFinite()) {
    return false;
  }
  for (int row = 0; row < program_.rows; ++row) {
    const auto coefficients = program_.constraints.row(row);
    const double tolerance = VELOCITY_TOLERANCE * std::max(1.0, coefficients.lpNorm<Eigen::Infinity>());
    if (!(coefficients.dot(solution_) >= program_.limits[row] - tolerance)) {
      return false;
    }
  }
  return true;
}

//! By how much the rows of each kind are missed; true if a limit is.
bool SafetyFilter::measureSlack(const Given& given) {
  for (int row = 0; row < given.rows.size(); ++row) {
    const double missing = given.rows.bound(row) - given.rows.coefficients(row).dot(result_.velocity);
    double& slack = result_.slack[given.rows.kind(row)];
    if (missing > VELOCITY_TOLERANCE) {
      slack = std::max(slack, missing);
    }
  }
  for (int kind = 0; kind < kinds(); ++kind) {
    if (isLimit(kind) && result_.slack[kind] > 0.0) {
      return true;
    }
  }
  return false;
}

}  // namespace control
}  // namespace deformable_manipulation
