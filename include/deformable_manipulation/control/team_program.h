#pragma once

#include <memory>
#include <vector>

#include "deformable_manipulation/control/barrier.h"
#include "deformable_manipulation/control/controller_parameters.h"
#include "deformable_manipulation/control/features.h"
#include "deformable_manipulation/control/predicted_state.h"
#include "deformable_manipulation/control/safety_filter.h"

namespace deformable_manipulation {
namespace control {

//! The quadratic program that decides the velocities of some assistants: the rows of all barriers and the safety
//! filter.
class TeamProgram {
 public:
  //! @param team the assistants that it decides for are the commanded ones
  //! @throw std::invalid_argument if a parameter cannot be used
  TeamProgram(const ControllerParameters& parameters, const Team& team);

  //! Continues with other weights and barriers of the same names; priority and solver stay.
  //! @throw std::invalid_argument if they cannot be used; nothing changes then
  void setParameters(const ControllerParameters& parameters, const Team& team);

  //! See SafetyFilter::setAnticipation.
  void setAnticipation(double weight) { filter_.setAnticipation(weight); }

  //! Uses another solver.
  void setSolver(QpSolver solver) { filter_.setSolver(std::move(solver)); }

  //! What the next solution is to come near to, and the bounds that it keeps.
  //! @param first of the three variables: 3 times the column of the assistant for its velocity, Team::turnOf() for its
  //! angular velocity
  void want(int first, const Vector3& nominal, const Vector3& lower, const Vector3& upper);

  //! The velocities of the commanded assistants, valid until the next call.
  const Filtered& solve(const Features& features, const PredictedState& predicted);

  //! [s] that the last solution took.
  double solveTime() const { return solve_time_; }

  const std::vector<std::unique_ptr<Barrier>>& barriers() const { return barriers_; }

  //! Whether a barrier's rows need to know how the object follows its held points.
  bool needsResponse() const;

 private:
  std::vector<std::unique_ptr<Barrier>> barriers_;
  SafetyFilter filter_;
  ConstraintRows rows_;
  Eigen::VectorXd nominal_;  // [3 M] m/s, where grips turn also [3 M] rad/s
  Eigen::VectorXd lower_;
  Eigen::VectorXd upper_;
  double solve_time_ = 0.0;
};

}  // namespace control
}  // namespace deformable_manipulation
