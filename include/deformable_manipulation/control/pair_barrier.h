#pragma once

#include <Eigen/Core>
#include <vector>

#include "deformable_manipulation/control/class_k.h"
#include "deformable_manipulation/control/constraint_rows.h"
#include "deformable_manipulation/control/situation.h"

namespace deformable_manipulation {
namespace control {

//! A barrier on the distance r between the held point i of each commanded assistant and each other one j.
//!
//! Overstretch: h = max_distance - margin - r (paper, eqs. 8 to 10). Proximity: h = r - min_distance - margin
//! (eqs. 11 and 12). With the unit vector a = (x_j - x_i) / r, dr/dt = a . (v_j - u_i), the gradient g of h with
//! respect to x_i is a for overstretch, -a for proximity, and dh/dt >= -alpha(h) becomes
//!
//!   g . u_i >= g . v_j - alpha(h).
//!
//! Against the leader, whose velocity v_j is measured, the assistant takes the whole constraint. Between two that
//! are commanded together both velocities are variables of one row,
//!
//!   g . (u_i - u_j) >= -alpha(h).
//!
//! Two assistants that are not share it. Each feeding back the other's last measured velocity would be a loop of gain
//! one with a delay, so each keeps its velocity relative to the leader's within half:
//!
//!   g_i . (u_i - v_leader) >= -alpha(h) / 2.
//!
//! As g_j = -g_i, the two halves sum to the whole constraint for any leader velocity, and a formation that
//! moves as one with the leader is never held back. Without shares each takes the whole constraint against
//! the other's measured velocity, as in the paper.
//!
//! Coincident held points have no direction; a fixed one is taken instead, along x from the agent of the
//! lower index to the other, so that both agents take opposite ones.
class PairBarrier {
 public:
  enum class Kind { OVERSTRETCH, PROXIMITY };

  //! @param commanded indices of the assistants whose velocities the rows are of, in their order
  //! @param leader index of the leader
  //! @param limits [A x A] m, distances to keep to, symmetric; the diagonal is not used
  //! @param margin [m] by which the rows stay within the limits
  PairBarrier(Kind kind, std::vector<int> commanded, int leader, Eigen::MatrixXd limits, double margin,
              PiecewiseLinearClassK alpha, bool shares = true);

  //! What is left of the limit between two agents [m], for the held points [A]; without the margin.
  double value(const std::vector<Vector3>& positions, int agent, int other) const;

  //! The least value of an agent over all others [m]; infinite if there is none.
  double lowest(const std::vector<Vector3>& positions, int agent) const;

  //! d value / d held point of the agent, a unit vector.
  Vector3 gradient(const std::vector<Vector3>& positions, int agent, int other) const;

  //! Adds one constraint for each pair of agents of which one is commanded.
  void addRows(const Situation& situation, ConstraintRows& rows) const;

 private:
  int agents() const { return static_cast<int>(limits_.rows()); }
  int columnOf(int agent) const;
  void addRow(const Situation& situation, int column, int other, ConstraintRows& rows) const;

  Tier tier_;
  double sign_;  // +1: stay farther than the limit, -1: stay nearer
  std::vector<int> commanded_;
  int leader_;
  Eigen::MatrixXd limits_;
  double margin_;
  PiecewiseLinearClassK alpha_;
  bool shares_;
};

}  // namespace control
}  // namespace deformable_manipulation
