#pragma once

#include <memory>
#include <vector>

#include "deformable_manipulation/control/barrier.h"
#include "deformable_manipulation/control/controller_parameters.h"
#include "deformable_manipulation/control/feature_memory.h"
#include "deformable_manipulation/control/leader_forecast.h"
#include "deformable_manipulation/control/object_forecast.h"
#include "deformable_manipulation/control/safety_filter.h"

namespace deformable_manipulation {
namespace control {

//! How an assistant is expected to follow.
struct Follower {
  Vector3 place;  //!< [m] relative to the leader
  bool follows;   //!< false: it stands still
};

//! Looks ahead: finds what the assistants have to do now so that the limits can still be kept later
//! (docs/mathematics.md, "Horizon").
//!
//! The leader is expected to do what LeaderForecast says, and the assistants to follow it by the nominal law. At
//! the nodes t_n of the horizon, the object rests in the shape that belongs to the held points there. The variables are
//! the departures y_k of the assistants from the nominal law, constant between two nodes,
//!
//!   min sum_k |diag(weights) y_k|^2  subject to  h(t_n) >= 0 for each node and barrier,  |u_k| <= u_max,
//!
//! with the barriers linearised about the last plan. Distances count less by what the leader may do otherwise until
//! t_n. The program is solved once per cycle and starts from the plan of
//! the cycle before. If the nominal law within its velocity breaks no limit within the horizon, it is the plan. What
//! the plan departs from that at first changes the nominal velocity of the present cycle, whose own limits stay as they
//! are. All assistants are in the plan, whoever commands them: each controller computes the same plan and follows its
//! own part.
class Horizon {
 public:
  //! @param forecast of the object
  Horizon(const ControllerParameters& parameters, std::shared_ptr<ObjectForecast> forecast);

  //! Other gains, limits and margins.
  void setParameters(const ControllerParameters& parameters);

  //! Forgets the last plan.
  void reset();

  //! Plans from an observed state.
  //! @param predicted the agents when the command begins to act
  //! @param followers [A]; the leader's is not used
  void plan(const ObservationView& observation, const PredictedState& predicted,
            const std::vector<Follower>& followers);

  //! [m/s] from the clipped nominal velocity of an assistant, for the present cycle.
  Vector3 departure(int agent) const;

 private:
  void follow(const PredictedState& predicted, const std::vector<Follower>& followers);
  void displace();
  void hold(int agents);
  void weigh();
  void addLimits(int node, double time);
  void addVelocities();
  const Eigen::VectorXd& best();
  void reach();
  Eigen::Index variable(int node, int column) const { return 3 * (node * columns() + column); }
  int columns() const { return static_cast<int>(team_.commanded.size()); }
  double timeOf(int node) const { return (node + 1) * interval_; }

  HorizonParameters parameters_;
  Team team_;            // that commands all assistants
  double change_ = 1.0;  // part of the way from the last plan to the new one that is taken in a cycle
  double max_velocity_ = 0.0;
  Vector3 weights_at_rest_;  // behind a leader at rest
  double interval_ = 0.0;    // [s]
  double clipping_ = 0.0;    // part of the clip in the law that departures count from
  double haste_ = 0.0;       // speed of the leader in multiples of the assistants', at most 1
  double gain_ = 0.0;        // [1/s] of the law with a constant velocity in each interval
  std::vector<std::unique_ptr<Barrier>> barriers_;
  std::unique_ptr<SafetyFilter> filter_;
  LeaderForecast leader_forecast_;
  std::shared_ptr<ObjectForecast> forecast_;

  //! What the nominal law and the last plan make of an assistant.
  struct Path {
    std::vector<Vector3> positions;   // [N + 1] m
    std::vector<Vector3> velocities;  // [N] m/s
    std::vector<Vector3> law;         // [N] m/s, the nominal velocities that departures count from
    std::vector<Vector3> pulls;       // [N] 1/s, of the law on a displacement in an interval
    std::vector<Vector3> kept;        // [N x N] s, displacement at a node over the departure in an interval
    double max_velocity;              // [m/s]
  };

  static Vector3 lawAt(const Path& path, int node, const Vector3& displacement);

  std::vector<Path> paths_;     // [M]
  std::vector<double> times_;   // [N] s, of the nodes
  std::vector<Vector3> held_;   // [N x A] m, by the last plan
  Eigen::VectorXd departures_;  // [N x M x 3] m/s, of the last plan from the clipped law
  Eigen::VectorXd from_law_;    // [N x M x 3] m/s, the last plan's departures from the law, which is not clipped
  Eigen::VectorXd displaced_;   // [N x M x 3] m, that they make, to first order
  Eigen::VectorXd free_;        // [N x M x 3] m, from the last plan to what the clipped law alone leads to
  bool unhindered_ = false;     // the clipped law alone keeps all limits
  Eigen::VectorXd zero_;
  Eigen::VectorXd lower_;  // [m/s] of departures from the law
  Eigen::VectorXd upper_;
  Eigen::VectorXd best_;
  Features features_;
  std::vector<FeatureMemory> memories_;  // [N]
  ConstraintRows node_rows_;             // on the displacements at a node
  ConstraintRows rows_;                  // on the departures
};

}  // namespace control
}  // namespace deformable_manipulation
