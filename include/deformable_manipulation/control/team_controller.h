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
  Eigen::MatrixXd limits;  //!< [A x A] m, between any two agents, symmetric; the diagonal is not used
  double margin = 0.0;     //!< [m] by which the rows stay within the limits
  PiecewiseLinearClassK alpha{1.0, 2.0};
};

struct ControllerParameters {
  std::vector<int> commanded;         //!< indices of the M assistants to command, among the A agents
  int leader = 0;                     //!< index of the leader
  std::vector<int> assistants;        //!< indices of all assistants
  std::vector<Vector3> references;    //!< [M] m, places to keep relative to the leader
  double cycle_time = 0.01;           //!< [s]
  double gain = 1.0;                  //!< [1/s]
  Vector3 weights = Vector3::Ones();  //!< cost of departing from the nominal velocity per axis
  double max_velocity = 0.15;         //!< [m/s] of every component
  double max_acceleration = 1.0;      //!< [m/s^2] of every component
  double smoothing = 0.0;             //!< [s] time constant of a departure from the nominal velocity; 0: none
  double timeout = 0.2;               //!< [s] a state older than the last by more means that time was set back
  bool exact_gradients = false;       //!< from the response, where it is known
  bool safety = true;                 //!< false: the nominal velocity within its limits
  Formulation formulation;
  Priority priority = DEFAULT_PRIORITY;
  CollisionParameters collision;
  PairParameters overstretch;
  PairParameters proximity;
};

//! Lets assistants follow the leader at fixed relative positions, as far as the barriers allow.
//!
//! One program over the velocities of all M assistants that it commands. With M = 1, a controller for each assistant
//! on its own observations alone, this is decentralised control: constraints between assistants are shared. With all
//! assistants commanded together it is centralised: each constraint is whole, and met by whoever meets it at the least
//! departure from the nominal velocities.
//!
//! The command computed from state k acts from state k + 1 to k + 2. So everything is predicted for state
//! k + 1 to first order (for a later one where the observation says that the answer is late): the own held points move
//! with the commands decided before, the others with their measured velocities. The nominal law is
//!
//!   u_nom = k_p e + v_leader,  e = x_leader + reference - x  at state k + 1,
//!
//! whose error decays by (1 - k_p / rate) per cycle whatever the delay, and is zero behind a leader of
//! constant velocity.
class TeamController {
 public:
  //! @throw std::invalid_argument if a parameter cannot be used
  explicit TeamController(const ControllerParameters& parameters);

  //! Another solver of the safety filter's program.
  void setSolver(QpSolver solver) { filter_.setSolver(std::move(solver)); }

  //! Number M of assistants that it commands; they are numbered in the order of the parameters.
  int size() const { return static_cast<int>(members_.size()); }

  //! False answers every state with zero velocity for this assistant; the others reckon with that.
  void setEnabled(int member, bool enabled) { members_[member].enabled = enabled; }
  bool isEnabled(int member) const { return members_[member].enabled; }

  //! Goes on with other gains, limits and margins of the same agents; formulation, priority and solver stay as they
  //! were made. @throw std::invalid_argument if they cannot be used; nothing changes then
  void setParameters(const ControllerParameters& parameters);

  //! Back to the start: forgets all states and takes the first references again.
  void reset();

  //! Lets an assistant follow the leader at its present relative position from now on. The observation must have
  //! no fault.
  void takeReference(int member, const ObservationView& observation);

  //! Whether a state is not newer than the last one, which then is to get the same answer again. One older by
  //! more than the timeout means that time was set back: all states are forgotten.
  bool isAnswered(double time);

  //! Decides the velocities for a state.
  //! @param observation without fault
  //! @return [M] valid until the next call
  const std::vector<Decision>& update(const ObservationView& observation);

  //! All stand still because an input is missing or unusable.
  const std::vector<Decision>& wait();

 private:
  void setSmoothing();

  struct Member {
    int agent;          // index
    Vector3 reference;  // [m]
    Vector3 command;    // [m/s] the last one, which acts until the next does
    Vector3 departure;  // [m/s] of it from its nominal velocity, by the rows
    bool enabled;
  };

  void forget();
  void stop();
  void clearDecisions();
  void predict(const ObservationView& observation);
  Vector3 nominal(const Member& member) const;
  void describe(const ObservationView& observation);
  void decide(const ObservationView& observation);
  bool findGradients(const ObservationView& observation);
  void describeGradients();
  void setBounds();
  void passUnfiltered();
  void passFiltered();
  void keepDeparture(bool rows_act, const Decision& decision, Member& member) const;
  void conclude();

  ControllerParameters parameters_;
  CollisionBarrier collision_;
  PairBarrier overstretch_;
  PairBarrier proximity_;
  VelocityEstimator velocities_;
  Differences differences_;
  SafetyFilter filter_;

  std::vector<Member> members_;
  std::vector<Decision> decisions_;  // [M]
  bool answered_ = false;
  double time_ = 0.0;  // [s] of the newest state, if answered
  std::vector<Vector3> positions_;
  Situation situation_;
  Features features_;
  ConstraintRows rows_;
  double kept_ = 0.0;        // part of a departure that is kept for the next cycle
  Eigen::VectorXd nominal_;  // [3 M] m/s, with that; of those who are disabled zero
  Eigen::VectorXd lower_;    // [3 M] m/s, velocities that the limits of velocity and acceleration allow
  Eigen::VectorXd upper_;
};

}  // namespace control
}  // namespace deformable_manipulation
