#pragma once

#include <vector>

#include "deformable_manipulation/control/class_k.h"
#include "deformable_manipulation/control/constraint_rows.h"
#include "deformable_manipulation/control/situation.h"

namespace deformable_manipulation {
namespace control {

//! A barrier on the distance r between an agent's held point i and each other one j.
//!
//! Overstretch: h = max_distance - margin - r (paper, eqs. 8 to 10). Proximity: h = r - min_distance - margin
//! (eqs. 11 and 12). With the unit vector a = (x_j - x_i) / r, dr/dt = a . (v_j - u_i), the gradient g of h with
//! respect to x_i is a for overstretch, -a for proximity, and dh/dt >= -alpha(h) becomes
//!
//!   g . u_i >= g . v_j - alpha(h).
//!
//! Against the leader, whose velocity v_j is measured, the agent takes the whole constraint. Two assistants
//! share it. Each feeding back the other's last measured velocity would be a loop of gain one with a delay, so
//! each keeps its velocity relative to the leader's within half:
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

  //! @param agent, leader indices of this agent and the leader
  //! @param limits [A] m, distances to keep to; the own entry is not used
  //! @param margin [m] by which the rows stay within the limits
  PairBarrier(Kind kind, int agent, int leader, std::vector<double> limits, double margin, PiecewiseLinearClassK alpha,
              bool shares = true);

  //! What is left of the limit against another agent [m], for the held points [A]; without the margin.
  double value(const std::vector<Vector3>& positions, int other) const;

  //! The least value over all other agents [m]; infinite if there is none.
  double lowest(const std::vector<Vector3>& positions) const;

  //! d value / d own held point, a unit vector.
  Vector3 gradient(const std::vector<Vector3>& positions, int other) const;

  //! Adds one constraint per other agent.
  void addRows(const Situation& situation, ConstraintRows& rows) const;

 private:
  int agents() const { return static_cast<int>(limits_.size()); }

  Tier tier_;
  double sign_;  // +1: stay farther than the limit, -1: stay nearer
  int agent_;
  int leader_;
  std::vector<double> limits_;
  double margin_;
  PiecewiseLinearClassK alpha_;
  bool shares_;
};

}  // namespace control
}  // namespace deformable_manipulation
