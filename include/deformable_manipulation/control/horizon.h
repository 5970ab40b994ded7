#pragma once

#include <memory>
#include <string>
#include <vector>

#include "deformable_manipulation/control/barrier.h"
#include "deformable_manipulation/control/controller_parameters.h"
#include "deformable_manipulation/control/object_forecast.h"
#include "deformable_manipulation/control/safety_filter.h"

namespace deformable_manipulation {
namespace control {

//! Looks ahead: what the assistants have to do now so that the limits can still be kept later.
//!
//! The leader is expected to go on with a velocity that fades, the assistants to follow it by the nominal law within
//! their velocity. At the nodes t_n of the horizon the object rests in the shape that belongs to the held points there.
//! Departures z_k of the assistants, constant between two nodes, are the variables of a program with all barriers as
//! linearised about the last plan:
//!
//!   min sum_k |diag(weights) z_k|^2  subject to  h(p_n) >= 0 for each node, barrier and assistant,  |u_k| <= u_max.
//!
//! Each cycle linearises once, and starts from the plan of the cycle before. Where the nominal law breaks no limit, the
//! departures are zero. The first of them moves the nominal velocity of the present cycle, whose own limits are left
//! as they are. All assistants are in the plan, whoever commands them: each computes the same plan, and follows its own
//! part.
class Horizon {
 public:
  //! @param forecast of the object
  Horizon(const ControllerParameters& parameters, std::shared_ptr<ObjectForecast> forecast);

  //! Other gains, limits and margins.
  void setParameters(const ControllerParameters& parameters);

  //! Forgets the last plan.
  void reset();

  //! What the leader will do, for the next plan alone.
  //! @param displacements [N] m, of the leader up to each node from where it is when the command begins to act
  void announce(std::vector<Vector3> displacements) { announced_ = std::move(displacements); }

  //! Plans from an observed state.
  //! @param predicted the agents when the command begins to act
  //! @param places [A] m, of the agents relative to the leader; the leader's is not used
  void plan(const ObservationView& observation, const PredictedState& predicted, const std::vector<Vector3>& places);

  //! [m/s] of an assistant from the nominal velocity, clipped to its limit, for the present cycle.
  Vector3 departure(int agent) const;

 private:
  void follow(const PredictedState& predicted, const std::vector<Vector3>& places);
  void displace();
  void addLimits(int node);
  void addVelocities();
  double carried(int from, int to) const;
  Eigen::Index variable(int node, int column) const { return 3 * (node * columns() + column); }
  int columns() const { return static_cast<int>(team_.commanded.size()); }
  double timeOf(int node) const { return (node + 1) * interval_; }

  HorizonParameters parameters_;
  Team team_;  // that commands all assistants
  double interval_ = 0.0;  // [s]
  double gain_ = 0.0;      // [1/s] of the law with a constant velocity in each interval
  double kept_ = 0.0;      // of an error after an interval
  std::vector<std::unique_ptr<Barrier>> barriers_;
  std::unique_ptr<SafetyFilter> filter_;
  std::shared_ptr<ObjectForecast> forecast_;

  std::vector<Vector3> announced_;              // [N] m, or none
  std::vector<Vector3> leader_;                 // [N + 1] m, of its held point, from now on
  std::vector<std::vector<Vector3>> followed_;  // [M][N + 1] m, of the assistants by the nominal law
  std::vector<std::vector<Vector3>> speeds_;    // [M][N] m/s, of them
  std::vector<Vector3> held_;                   // [N x A] m, by the last plan
  Eigen::VectorXd departures_;                  // [N x M x 3] m/s
  Eigen::VectorXd displaced_;                   // [N x M x 3] m, from what the nominal law does
  Eigen::VectorXd zero_;
  Eigen::VectorXd reach_;
  Features features_;
  ConstraintRows node_rows_;  // on displacements of a node
  ConstraintRows rows_;       // on departures
};

}  // namespace control
}  // namespace deformable_manipulation
