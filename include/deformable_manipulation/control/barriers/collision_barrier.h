#pragma once

#include "deformable_manipulation/control/barrier.h"
#include "deformable_manipulation/control/class_k.h"

namespace deformable_manipulation {
namespace control {

struct CollisionParameters {
  double offset;                       //!< [m] distance to keep
  double margin;                       //!< [m] beyond the offset, that the rows keep
  double speed_margin;                 //!< [s] more of it per m/s of the leader's speed
  double snap_margin;                  //!< [m] up to this much more while the copies part
  double band;                         //!< [m] features farther than the nearest by more have no row
  PiecewiseLinearClassK alpha;         //!< of the limit
  PiecewiseLinearClassK anticipation;  //!< of the softer row beside each

  //! Reads the section `controller.collision`.
  static CollisionParameters read(const ParameterSection& collision);
};

//! Keeps the object off the obstacles: h_m = distance_m - offset for each near feature m (paper, eqs. 3 to 7).
//!
//! With the gradients g_a of agent a, the normal n, the obstacle's velocity w and the sum of g_a over all
//! agents n (see Features),
//!
//!   dh/dt = sum_a g_a . v_a - n . w = sum over assistants g_i . (u_i - v_leader) + n . (v_leader - w).
//!
//! Assistants that are not commanded together share dh/dt >= -alpha(h) in proportion to what they can do. For the
//! commanded assistants i, with s = (sum of g_i^2 over them) / (sum of g^2 over all assistants),
//!
//!   sum_i g_i . (u_i - v_leader) >= -s (n . (v_leader - w) + alpha(h)).
//!
//! The shares sum to the whole constraint; no assistant's velocity is fed back to another, and a formation
//! that moves as one with the leader along the obstacle is not held back. If all assistants are commanded
//! together, or there is only one, s = 1: sum_i g_i . u_i + g_leader . v_leader - n . w >= -alpha(h).
//!
//! A disturbance (see DisturbanceObserver) that reduces the distance is added to n . (v_leader - w). One that increases
//! it is ignored.
//!
//! The rows stay above the offset by margin + speed_margin |v_leader|, and use the distance predicted for
//! the time when the command acts. Each feature has a second row of the same form, a wish with a gentler slope,
//! which asks earlier for what the first row will demand. Towards the edge of the band both rows loosen until every
//! velocity satisfies them, so that features come and go without a step in the command.
class CollisionBarrier : public Barrier {
 public:
  CollisionBarrier(const CollisionParameters& parameters, const Team& team) : parameters_(parameters), team_(team) {}

  //! h [m] of the minimum distance, the same for all agents.
  double value(const PresentState& state, int agent) const override;

  void addRows(const Features& features, const PredictedState& state, BarrierRows& rows) const override;

 private:
  Vector3 leaderVelocity(const PredictedState& state) const;
  Vector3 obstacleVelocity(const Features& features, int feature) const;
  double predictedDistance(const Features& features, int feature, const PredictedState& state) const;
  double shareOf(const Features& features, int feature) const;

  CollisionParameters parameters_;
  Team team_;
};

}  // namespace control
}  // namespace deformable_manipulation
