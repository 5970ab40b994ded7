#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <functional>

namespace deformable_manipulation {
namespace control {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

//! min 1/2 x' diag(hessian) x + linear' x  subject to  constraints x >= limits.
//!
//! Only the first `rows` rows of constraints and limits count. The memory is reused from one program to the next.
struct QuadraticProgram {
  Eigen::VectorXd hessian;  //!< [n] diagonal, positive
  Eigen::VectorXd linear;   //!< [n]
  RowMatrix constraints;    //!< [at least rows, n]
  Eigen::VectorXd limits;   //!< [at least rows]
  int rows = 0;

  int variables() const { return static_cast<int>(hessian.size()); }

  //! Makes a program without rows, with room for some.
  void clear(int most) {
    if (limits.size() < most || constraints.cols() != variables()) {
      limits.resize(std::max<Eigen::Index>(most, limits.size()));
      constraints.resize(limits.size(), variables());
    }
    rows = 0;
  }

  //! Adds a row of zeros at the end, to be filled in.
  auto addRow(double limit) {
    limits[rows] = limit;
    return constraints.row(rows++).setZero();
  }
};

//! Finds the solution x [n] of a program; false if it finds none.
using QpSolver = std::function<bool(const QuadraticProgram&, Eigen::VectorXd& x)>;

}  // namespace control
}  // namespace deformable_manipulation
