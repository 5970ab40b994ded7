#pragma once

#include <Eigen/Core>
#include <vector>

#include "deformable_manipulation/control/quadratic_program.h"

namespace deformable_manipulation {
namespace control {

//! Solver of small dense strictly convex quadratic programs of diagonal Hessian.
//!
//! This is the dual active-set method of Goldfarb and Idnani (1983). It starts at the minimum without constraints and
//! adds the most violated constraint, dropping those that block it, until all hold. In the variables
//! y = diag(hessian)^(1/2) x the cost is half the squared distance from the start, so that the factorisation
//! N = Q R of the active constraints' normals is all that needs to be kept. Violations are measured as
//! distances of y, whatever the scale of the rows.
//!
//! The number of iterations is bounded. A row that is nearly a combination of active ones never joins them,
//! so parallel rows and rows that meet in one point do no harm. Equal programs give equal solutions.
//! Nothing is allocated once the largest program has been solved.
class DualActiveSet {
 public:
  enum class Outcome {
    OPTIMAL,
    INFEASIBLE,
    UNSOLVED  //!< not within the bound of iterations, or a number is not finite
  };

  //! @param program of positive Hessian; numbers that are not finite give UNSOLVED
  Outcome solve(const QuadraticProgram& program);

  //! [n] of the last program, if OPTIMAL.
  const Eigen::VectorXd& solution() const { return solution_; }

  //! Constraints added or dropped for the last program.
  int iterations() const { return iterations_; }

 private:
  enum class Step { TAKEN_IN, DROPPED, IMPOSSIBLE };

  bool scale(const QuadraticProgram& program);
  int mostViolated() const;
  Step step(int entering, double& multiplier);
  int firstToBlock(double& length) const;
  void takeIn(int row, double multiplier);
  void drop(int place);
  void rotate(int first, double a, double b);

  int n_ = 0;
  int rows_ = 0;
  int iterations_ = 0;
  double tolerance_ = 0.0;
  Eigen::VectorXd root_;         // [n] of the Hessian's diagonal
  RowMatrix normals_;            // [rows, n] of unit length, in y
  Eigen::VectorXd levels_;       // [rows] normals y >= levels
  Eigen::VectorXd y_;            // [n]
  Eigen::VectorXd solution_;     // [n]
  Eigen::MatrixXd Q_;            // [n, n] the first columns span the active normals
  Eigen::MatrixXd R_;            // [n, n] upper triangle
  Eigen::VectorXd d_;            // [n] Q' times the entering normal
  Eigen::VectorXd direction_;    // [n] of y while the entering constraint's multiplier grows by one
  Eigen::VectorXd reduction_;    // [n] of the active multipliers meanwhile
  Eigen::VectorXd multipliers_;  // [n] of the active constraints
  std::vector<int> active_;      // rows, in the order of the columns of R
  std::vector<char> is_active_;  // [rows]
};

}  // namespace control
}  // namespace deformable_manipulation
