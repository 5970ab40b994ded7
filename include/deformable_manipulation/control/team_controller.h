#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "deformable_manipulation/control/assistant_intent.h"
#include "deformable_manipulation/control/controller_parameters.h"
#include "deformable_manipulation/control/coordination.h"
#include "deformable_manipulation/control/decision.h"
#include "deformable_manipulation/control/gradients.h"
#include "deformable_manipulation/control/horizon.h"
#include "deformable_manipulation/control/observation.h"
#include "deformable_manipulation/control/team_member.h"
#include "deformable_manipulation/control/team_program.h"
#include "deformable_manipulation/control/velocity_estimator.h"

namespace deformable_manipulation {
namespace control {

//! Lets assistants follow the leader at fixed relative positions, as far as the barriers allow.
//!
//! One program decides the velocities of all M assistants that it commands. With M = 1, one controller per assistant on
//! its own observations only, control is decentralised: assistants share the constraints between them. If one program
//! commands all assistants, control is centralised: each constraint is whole, and is met with the smallest deviation
//! from the nominal velocities. The limits are a list of barriers.
//!
//! Coordinated control is decentralised, too: each controller solves the program of all assistants, and commands only
//! its own ones. On the same states all controllers come to the same solution. They tell one another their intents,
//! so that each knows who follows, and from where. While nothing is heard of another assistant, or it does something
//! else than expected, the own ones take their share of each constraint and no more.
//!
//! The command computed from state k acts from state k + 1 to k + 2. So everything is predicted for state
//! k + 1 to first order, or for a later state if the observation says that the answer is late: the commanded held
//! points move with the previous commands, the others with their measured velocities. The nominal law is
//!
//!   u_nom = k_p e + v_leader,  e = x_leader + reference - x  at state k + 1,
//!
//! Its error decays by (1 - k_p / rate) per cycle, whatever the delay, and is zero behind a leader of constant
//! velocity.
class TeamController {
 public:
  //! @throw std::invalid_argument if a parameter cannot be used
  explicit TeamController(const ControllerParameters& parameters);

  //! Uses another solver for the safety filter's program.
  void setSolver(const QpSolver& solver);

  //! Takes it that the others go on as expected, however long nothing is heard of them: for lock-step, where every
  //! controller answers every state.
  void setTrusting(bool trusting) { coordination_.setTrusting(trusting); }

  //! Looks ahead with this forecast of the object, see Horizon; without one the present cycle is all that counts.
  void setForecast(std::shared_ptr<ObjectForecast> forecast);

  //! Lets an own assistant that is held off its place take a way around that this search finds.
  void setDetour(int member, DetourSearch search);

  //! Number M of assistants that it commands; they are numbered in the order of the parameters.
  int size() const { return static_cast<int>(members_.size()); }

  //! False brings this assistant to rest, within its limits, and keeps it there; the others take that into account.
  void setEnabled(int member, bool enabled) { members_[member].enabled = enabled; }
  bool isEnabled(int member) const { return members_[member].enabled; }

  //! The lowest h of each barrier for an assistant in any state, without margins, in the order of the parameters.
  std::vector<double> margins(int member, const PresentState& state) const;

  //! Continues with other gains, limits and margins of the same agents; formulation, priority and solver stay.
  //! @throw std::invalid_argument if they cannot be used; nothing changes then
  void setParameters(const ControllerParameters& parameters);

  //! Goes back to the start: forgets all states and uses the first references again.
  void reset();

  //! Lets an assistant follow the leader at its present relative position from now on. The observation must have
  //! no fault.
  void takeReference(int member, const ObservationView& observation);

  //! How an own assistant goes on from the state that was answered last, for the other controllers.
  AssistantIntent intent(int member) const;

  //! Takes in what another controller tells about one of its assistants, for the states after it. What is told about
  //! own assistants, or is older than what was told before, is ignored.
  //! @param intent finite
  void hear(int member, const AssistantIntent& intent);

  //! Whether a state is not newer than the last one; it then gets the same answer again. If it is older by more than
  //! the timeout, time was set back: all states are forgotten.
  bool isAnswered(double time);

  //! Decides the velocities for a state.
  //! @param observation without fault
  //! @return [M] valid until the next call
  const std::vector<Decision>& update(const ObservationView& observation);

  //! Call this if an input is missing or unusable: all assistants slow down to rest, within their limits, and stand
  //! still. Each call is one command.
  const std::vector<Decision>& wait();

 private:
  void setSmoothing();

  void forget();
  void clearDecisions();
  void predict(const ObservationView& observation);
  void findWays(const ObservationView& observation);
  double lowestMargin(const PresentState& state, int agent) const;
  Vector3 nominal(const TeamMember& member) const;
  void describe(const ObservationView& observation);
  void decide(const ObservationView& observation);
  bool gradientsAreKnown();
  void describeGradients();
  MotionLimits motionLimits() const;
  void setBounds();
  void lookAhead(const ObservationView& observation);
  void passUnfiltered();
  void passFiltered();
  void decideBy(TeamProgram& program, const std::vector<int>& members);
  void keepDeparture(const Decision& decision, TeamMember& member) const;
  void conclude();

  ControllerParameters parameters_;
  VelocityEstimator velocities_;
  Gradients gradients_;
  Coordination coordination_;
  TeamProgram together_;                // of all members
  std::unique_ptr<TeamProgram> alone_;  // of the own ones; null: these are all
  std::shared_ptr<ObjectForecast> forecast_;
  std::unique_ptr<Horizon> horizon_;  // null: does not look ahead

  std::vector<TeamMember> members_;
  std::vector<int> all_;             // their numbers
  bool waits_ = false;               // for an input
  std::vector<Follower> followers_;  // [A]
  std::vector<Decision> decisions_;  // [M]
  std::optional<double> answered_;   // [s] time of the newest state
  PresentState present_;
  std::vector<Vector3> moved_;  // [A] m/s, measured velocities of the held points
  PredictedState predicted_;
  double kept_ = 0.0;  // part of a deviation that is kept for the next cycle
};

}  // namespace control
}  // namespace deformable_manipulation
