#pragma once

#include <vector>

#include "deformable_manipulation/control/class_k.h"
#include "deformable_manipulation/control/constraint_rows.h"
#include "deformable_manipulation/control/features.h"
#include "deformable_manipulation/control/formulation.h"
#include "deformable_manipulation/control/situation.h"

namespace deformable_manipulation {
namespace control {

struct CollisionParameters {
  double offset = 0.0;        //!< [m] distance to keep
  double margin = 0.0;        //!< [m] beyond the offset, that the rows keep
  double speed_margin = 0.0;  //!< [s] more of it per m/s of the leader's speed
  double band = 0.1;          //!< [m] features farther than the nearest by this have no row
  PiecewiseLinearClassK alpha{1.0, 5.0};
  PiecewiseLinearClassK anticipation{0.4, 5.0};
};

//! Keeps the object off the obstacles: h_m = distance_m - offset for each near feature m (paper, eqs. 3 to 7).
//!
//! With the gradients g_a of agent a, the normal n, the obstacle's velocity w and the sum of g_a over all
//! agents n (see Features),
//!
//!   dh/dt = sum_a g_a . v_a - n . w = sum over assistants g_i . (u_i - v_leader) + n . (v_leader - w).
//!
//! Those who are not commanded together share dh/dt >= -alpha(h) in proportion to what they can do. For the commanded
//! assistants i, with s = (sum of g_i^2 over them) / (sum of g^2 over all assistants),
//!
//!   sum_i g_i . (u_i - v_leader) >= -s (n . (v_leader - w) + alpha(h)).
//!
//! The shares sum to the whole constraint; no assistant's velocity is fed back to another, and a formation
//! that moves as one with the leader along the obstacle is not held back. Where all assistants are commanded
//! together, as is a single one, s = 1: sum_i g_i . u_i + g_leader . v_leader - n . w >= -alpha(h).
//!
//! The rows stay above the offset by margin + speed_margin |v_leader|, and take the distance as predicted for
//! the time when the command acts. A second row of the same form for each feature, of the tier ANTICIPATION
//! and a gentler slope, asks earlier for what the first will demand. Towards the edge of the band both
//! loosen until no velocity is beyond them, so that features come and go without a step in the command.
class CollisionBarrier {
 public:
  //! @param commanded indices of the assistants whose velocities the rows are of, in their order
  //! @param assistants indices of all assistants, the commanded ones among them
  //! @param max_velocity [m/s] bound on every component
  CollisionBarrier(std::vector<int> commanded, std::vector<int> assistants, const CollisionParameters& parameters,
                   double max_velocity, const Formulation& formulation = {});

  //! h [m] of a signed distance [m]; without margins.
  double value(double distance) const { return distance - parameters_.offset; }

  //! Adds the constraints of each feature of the present state.
  void addRows(const Features& features, const Situation& situation, ConstraintRows& rows) const;

 private:
  Vector3 leaderVelocity(const Situation& situation) const;
  Vector3 obstacleVelocity(const Features& features, int feature) const;
  double predictedDistance(const Features& features, int feature, const Situation& situation) const;
  double shareOf(const Features& features, int feature) const;

  std::vector<int> commanded_;
  std::vector<int> assistants_;
  CollisionParameters parameters_;
  double max_velocity_;
  Formulation formulation_;
};

}  // namespace control
}  // namespace deformable_manipulation
