#pragma once

#include <string>
#include <vector>

#include "deformable_manipulation/control/collision_barrier.h"
#include "deformable_manipulation/control/decision.h"
#include "deformable_manipulation/control/differences.h"
#include "deformable_manipulation/control/formulation.h"
#include "deformable_manipulation/control/observation.h"
#include "deformable_manipulation/control/pair_barrier.h"
#include "deformable_manipulation/control/response_gradients.h"
#include "deformable_manipulation/control/safety_filter.h"
#include "deformable_manipulation/control/velocity_estimator.h"

namespace deformable_manipulation {
namespace control {

//! What keeps a pair of agents within its limits.
struct PairParameters {
  std::vector<double> limits;  //!< [A] m, against each other agent; the own entry is not used
  double margin = 0.0;         //!< [m] by which the rows stay within the limits
  PiecewiseLinearClassK alpha{1.0, 2.0};
};

struct ControllerParameters {
  int agent = 1;                        //!< index of this assistant among the A agents
  int leader = 0;                       //!< index of the leader
  std::vector<int> assistants;          //!< indices of all assistants
  Vector3 reference = Vector3::Zero();  //!< [m] place to keep relative to the leader
  double cycle_time = 0.01;             //!< [s]
  double gain = 1.0;                    //!< [1/s]
  Vector3 weights = Vector3::Ones();    //!< cost of departing from the nominal velocity per axis
  double max_velocity = 0.15;           //!< [m/s] of every component
  double max_acceleration = 1.0;        //!< [m/s^2] of every component
  double timeout = 0.2;                 //!< [s] a state older than the last by more means that time was set back
  bool exact_gradients = false;         //!< from the response, where it is known
  bool safety = true;                   //!< false: the nominal velocity within its limits
  Formulation formulation;
  Priority priority = DEFAULT_PRIORITY;
  CollisionParameters collision;
  PairParameters overstretch;
  PairParameters proximity;
};

//! Follows the leader at a fixed relative position, as far as the barriers allow.
//!
//! The command computed from state k acts from state k + 1 to k + 2. So everything is predicted for state
//! k + 1 to first order: the own held point moves with the command decided from state k - 1, the others with
//! their measured velocities. The nominal law is
//!
//!   u_nom = k_p e + v_leader,  e = x_leader + reference - x  at state k + 1,
//!
//! whose error decays by (1 - k_p / rate) per cycle whatever the delay, and is zero behind a leader of
//! constant velocity. Decentralised: it uses its own observations alone.
class AssistantController {
 public:
  //! @throw std::invalid_argument if a parameter cannot be used
  explicit AssistantController(const ControllerParameters& parameters);

  //! False answers every state with zero velocity.
  bool enabled = true;

  //! Another solver of the safety filter's program.
  void setSolver(QpSolver solver) { filter_.setSolver(std::move(solver)); }

  //! Goes on with other parameters of the same agents; formulation and priority stay as they were made.
  //! @throw std::invalid_argument if they cannot be used; nothing changes then
  void setParameters(const ControllerParameters& parameters);

  //! Back to the start: forgets all states and takes the first reference again.
  void reset();

  //! Follows the leader at the present relative position from now on. The observation must have no fault.
  void takeReference(const ObservationView& observation);

  //! Whether a state is not newer than the last one, which then is to get the same answer again. One older by
  //! more than the timeout means that time was set back: all states are forgotten.
  bool isAnswered(double time);

  //! Decides the velocity for a state.
  //! @param observation without fault
  //! @return valid until the next call
  const Decision& update(const ObservationView& observation);

  //! Stands still because an input is missing or unusable.
  const Decision& wait();

 private:
  void forget();
  void predict(const ObservationView& observation);
  Vector3 nominal() const;
  void describe(const ObservationView& observation);
  bool findGradients(const ObservationView& observation);
  void describeGradients();
  void decide(bool usable);
  void setBounds();
  void passUnfiltered();
  void passFiltered();

  ControllerParameters parameters_;
  CollisionBarrier collision_;
  PairBarrier overstretch_;
  PairBarrier proximity_;
  VelocityEstimator velocities_;
  Differences differences_;
  SafetyFilter filter_;

  Vector3 reference_;
  Vector3 command_;
  bool answered_ = false;
  double time_ = 0.0;  // [s] of the newest state, if answered
  std::vector<Vector3> positions_;
  Situation situation_;
  Features features_;
  ConstraintRows rows_;
  Eigen::VectorXd nominal_;
  Eigen::VectorXd lower_;  // [m/s] velocities that the limits of velocity and acceleration allow
  Eigen::VectorXd upper_;
  Decision decision_;
};

}  // namespace control
}  // namespace deformable_manipulation
