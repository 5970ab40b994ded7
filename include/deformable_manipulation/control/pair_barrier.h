#pragma once

#include <Eigen/Core>
#include <vector>

#include "deformable_manipulation/control/barrier.h"
#include "deformable_manipulation/control/class_k.h"

namespace deformable_manipulation {
namespace control {

//! Parameters that keep a pair of agents within a limit of their distance.
struct PairParameters {
  Eigen::MatrixXd limits;  //!< [A x A] m, between any two agents, symmetric; the diagonal is not used
  double margin;           //!< [m] by which the rows stay within the limits
  PiecewiseLinearClassK alpha;

  //! Reads the section of a barrier on pairs, for a number of agents.
  static PairParameters read(const ParameterSection& section, int agents);
};

//! A barrier on the distance r between the held point i of each commanded assistant and each other one j.
//!
//! Overstretch: h = max_distance - margin - r (paper, eqs. 8 to 10). Proximity: h = r - min_distance - margin
//! (eqs. 11 and 12). With the unit vector a = (x_j - x_i) / r, dr/dt = a . (v_j - u_i), the gradient g of h with
//! respect to x_i is a for overstretch, -a for proximity, and dh/dt >= -alpha(h) becomes
//!
//!   g . u_i >= g . v_j - alpha(h).
//!
//! Against the leader, whose velocity v_j is measured, the assistant takes the whole constraint. If two assistants are
//! commanded together, both velocities are variables of one row,
//!
//!   g . (u_i - u_j) >= -alpha(h).
//!
//! Otherwise two assistants share the constraint. If each fed back the other's last measured velocity, that would be a
//! delayed loop with gain one. So each keeps its velocity relative to the leader's within half of the constraint:
//!
//!   g_i . (u_i - v_leader) >= -alpha(h) / 2.
//!
//! As g_j = -g_i, the two halves sum to the whole constraint for any leader velocity, and a formation that
//! moves as one with the leader is never held back. Without shares each takes the whole constraint against
//! the other's measured velocity, as in the paper.
//!
//! Coincident held points have no direction. A fixed one is used instead, along x from the agent with the
//! lower index to the other, so that both agents use opposite directions.
class PairBarrier : public Barrier {
 public:
  enum class Kind { MAXIMUM, MINIMUM };

  PairBarrier(Kind kind, const PairParameters& parameters, const Team& team);

  //! The remaining distance to the limit between two agents [m], for the held points [A], without the margin.
  double value(const std::vector<Vector3>& positions, int agent, int other) const;

  //! The lowest value of an agent over all others [m].
  double value(const PresentState& state, int agent) const override;

  //! d value / d held point of the agent, a unit vector.
  Vector3 gradient(const std::vector<Vector3>& positions, int agent, int other) const;

  //! Adds one constraint for each pair of agents with a commanded one.
  void addRows(const Features& features, const PredictedState& state, BarrierRows& rows) const override;

 private:
  void addRow(const PredictedState& state, int column, int other, BarrierRows& rows) const;

  double sign_;  // +1: stay farther than the limit, -1: stay nearer
  PairParameters parameters_;
  Team team_;
};

}  // namespace control
}  // namespace deformable_manipulation
