#pragma once

#include <Eigen/Core>
#include <vector>

#include "deformable_manipulation/control/constraint_rows.h"
#include "deformable_manipulation/control/dual_active_set.h"
#include "deformable_manipulation/control/quadratic_program.h"
#include "deformable_manipulation/control/status.h"

namespace deformable_manipulation {
namespace control {

//! [m/s] by which a constraint may be missed before it counts as relaxed.
constexpr double VELOCITY_TOLERANCE = 1e-6;

//! Quadratic cost of the anticipation's slack, in multiples of the cost of deviating from the nominal velocity.
constexpr double ANTICIPATION_WEIGHT = 10.0;

//! The order in which the L limits yield, by their kinds 0 to L - 1: the first one yields last.
using Priority = std::vector<int>;

//! Result of the safety filter.
struct Filtered {
  Eigen::VectorXd velocity;        //!< [n] m/s always finite and within the bounds, or zero if FAILED
  Status status = Status::FAILED;  //!< NOMINAL, CONSTRAINED, RELAXED or FAILED
  std::vector<double> slack;       //!< [L + 1] m/s by how much the rows of each kind are missed at most
  int rows = 0;
  bool rows_act = false;  //!< the bounds alone would allow another velocity
};

//! The velocity nearest to the nominal one that the constraints allow.
//!
//! min 1/2 |diag(weights) (u - nominal)|^2 subject to rows and bounds (paper, eq. 13). The bounds always hold.
//! The rows of a kind share one slack s_t >= 0:
//!
//!   min 1/2 |diag(weights) (u - nominal)|^2 + sum_t (c_t s_t + r_t s_t^2 / 2),
//!   rows of kind t: g . u >= min(b, most that g . u reaches within the bounds) - s_t.
//!
//! The linear penalty makes the slack of a limit exactly zero wherever the limit can hold. The quadratic penalty,
//! r = max(weights)^2, only makes the cost positive definite. In the order of the priority, the costs c_t differ by the
//! same factor from one limit to the next: a hundred for three limits. The order is not strictly lexicographic, because
//! a strict order would give up a lower limit completely to gain a micrometre per second in a higher one, which a row
//! with almost no gradient may ask for. So a higher limit yields to a lower one only if holding it would cost the lower
//! one more than that factor. The range of the costs is fixed, so that any number of limits keeps the solution precise.
//! Anticipation has only the quadratic penalty: it pulls more the farther it is missed, and never wins over a limit.
//!
//! The minimum keeps a row that no velocity can satisfy from loosening the other rows of its kind; the reported slack
//! includes what that row lacks. If two rows of a limit pull against each other, the one that asks for more, in
//! multiples of what the bounds allow, yields that much less: the coefficient of its s_t is less than one. Otherwise
//! two rows out of reach would hold each other in the middle of the bounds forever.
//!
//! One program with one solution that is continuous in all its inputs does not jump when limits begin to contradict
//! each other.
class SafetyFilter {
 public:
  //! @param weights gamma [n], positive
  //! @param priority of the limits
  //! @param relaxation false: rows that cannot all hold give FAILED (the paper)
  //! @throw std::invalid_argument if a weight is not positive and finite, or the priority is not an order of the limits
  SafetyFilter(const Eigen::VectorXd& weights, const Priority& priority, bool relaxation);

  SafetyFilter(const SafetyFilter&) = delete;
  SafetyFilter& operator=(const SafetyFilter&) = delete;

  //! Sets as many other weights. @throw std::invalid_argument if one is not positive and finite
  void setWeights(const Eigen::VectorXd& weights);

  //! Quadratic cost of the anticipation's slack, in multiples of the cost of deviating from the nominal velocity.
  void setAnticipation(double weight) { anticipation_ = weight; }

  //! Uses another solver instead of DualActiveSet.
  void setSolver(QpSolver solver) { solver_ = std::move(solver); }

  //! @param nominal, lower, upper [n] m/s
  //! @param rows of n components, of the kinds 0 to L
  //! @return valid until the next call; FAILED with zero velocity if a number is not finite, a lower
  //! bound exceeds its upper one, or the solver gives no valid solution
  const Filtered& filter(const Eigen::VectorXd& nominal, const ConstraintRows& rows, const Eigen::VectorXd& lower,
                         const Eigen::VectorXd& upper);

 private:
  struct Given {
    const Eigen::VectorXd& nominal;
    const ConstraintRows& rows;
    const Eigen::VectorXd& lower;
    const Eigen::VectorXd& upper;
  };

  Status decide(const Given& given);
  bool holds(const Given& given) const;
  void formulate(const Given& given);
  void measureDemands(const Given& given);
  int kinds() const { return static_cast<int>(penalties_.size()); }
  bool isLimit(int kind) const { return penalties_[kind] > 0.0; }
  double yielding(const Given& given, int row) const;
  void addRow(const Given& given, int row);
  void addBounds(const Given& given);
  bool solve(const Given& given);
  bool isValid() const;
  bool measureSlack(const Given& given);

  Eigen::VectorXd squares_;        // [n] of the weights, the largest 1: only their ratios matter
  std::vector<double> penalties_;  // [L + 1] of the kinds' slacks; of anticipation zero
  bool relaxation_;
  double anticipation_ = ANTICIPATION_WEIGHT;
  QpSolver solver_;
  DualActiveSet native_;
  QuadraticProgram program_;
  std::vector<double> demands_;  // of the rows, in multiples of what the bounds allow
  Eigen::VectorXd solution_;     // velocity, then slacks
  Filtered result_;
};

}  // namespace control
}  // namespace deformable_manipulation
