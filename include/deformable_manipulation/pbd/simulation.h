#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "deformable_manipulation/pbd/body.h"
#include "deformable_manipulation/pbd/shape_correction.h"

namespace deformable_manipulation {
namespace pbd {

//! An agent that holds one particle of the object, or several as one rigid piece, and moves as commanded.
struct Agent {
  std::string name;
  int particle = 0;
  Hold hold = Hold::CLAMPED;
  Pose start;                     //!< held point at the start
  std::vector<int> further = {};  //!< particles held besides, as they lie around the first one on the undeformed object
};

//! A perturbed copy: the held point of one agent displaced.
struct Perturbation {
  int agent;
  Vector3 displacement;  //!< [m]
};

//! Division of time.
struct Clock {
  double time_step;     //!< [s]
  int substeps;         //!< per time step
  int steps_per_cycle;  //!< time steps between two states

  double cycleTime() const { return time_step * steps_per_cycle; }

  //! @throw ParameterError
  void check() const;
};

//! A deformable object carried by velocity-controlled agents, with its perturbed copies.
//!
//! The object starts at rest between the agents, in a stable shape if it finds one (see rest()). A command that is set
//! between two advances acts in the next one, until it is replaced.
class Simulation {
 public:
  //! Settles the object between the agents' starts.
  //! @param perturbations  copies that are there, displaced and settled, from the start on
  //! @throw ParameterError with everything that is wrong with agents, perturbations or clock
  //! @throw NonFiniteState
  Simulation(std::unique_ptr<Body> body, std::vector<Agent> agents, const std::vector<Perturbation>& perturbations,
             const Clock& clock);

  //! How the object rests at the start.
  Rest rest() const { return rest_; }

  //! @throw std::out_of_range if there is no such agent
  //! @throw std::invalid_argument if the twist is not finite
  void setCommand(int agent, const Twist& twist);

  //! Advances by a cycle. @throw NonFiniteState
  void advance();

  //! Goes back to the settled start; raises resetCount().
  void reset();

  //! Adds a copy while running; it comes and goes with the agent's hold. @return its id
  //! @throw std::out_of_range as Body::addCopy()
  //! @throw std::invalid_argument as Body::addCopy()
  int addPerturbation(const Perturbation& perturbation);

  //! Removes copies by their ids. @throw std::invalid_argument if there is no such copy.
  void removePerturbations(const std::vector<int>& ids);

  //! Replaces all copies, now and for later resets, which settle the object again.
  //! @throw std::out_of_range as Body::addCopy(); nothing changes then.
  //! @throw std::invalid_argument as Body::addCopy(); nothing changes then.
  void setPerturbations(const std::vector<Perturbation>& perturbations);

  //! Removes the copies that displace an agent.
  void clearPerturbations(int agent);

  //! Releases the particle that an agent holds; the agent moves on by itself.
  //! @throw std::out_of_range if there is no such agent
  //! @throw std::logic_error if it holds none
  void release(int agent);

  //! Grips a particle where it is, and further ones where they are; the agent is put there, and its perturbed copies
  //! come back.
  //! @throw std::out_of_range if there is no such agent or particle
  //! @throw std::logic_error if the agent holds one already, another agent holds one of
  //! these, or one is farther than kGripReach from the agent, or from where the undeformed object has it around the
  //! first.
  void hold(int agent, int particle, Hold type, const std::vector<int>& further = {});

  //! [m] An agent can grip a particle up to this far from it.
  static constexpr double kGripReach = 0.1;

  //! Changes material parameters now and for later resets, which settle the object again.
  //! @throw ParameterError as Body::setMaterial(); nothing changes then.
  void setMaterial(const std::vector<MaterialParameter>& parameters);

  //! From now on measured points correct where the object is, see points().
  //! @throw ParameterError if it is no line
  void correct(const CorrectionParameters& parameters);

  //! Takes over what was seen of the object.
  //! @param time [s] since the start, at which it was seen
  //! @return why it is not used; empty: it is
  //! @throw std::logic_error if nothing is corrected
  std::string measure(double time, const std::vector<MeasuredPoint>& points);

  //! Null: nothing is corrected.
  const ShapeCorrection* correction() const { return correction_ ? &*correction_ : nullptr; }

  //! Geometry points [m] of all copies, corrected, [copies x pointCount x 3].
  void points(double* to) const;

  const Body& body() const { return *body_; }
  const std::vector<Agent>& agents() const { return agents_; }
  const Clock& clock() const { return clock_; }

  //! Index of the agent whose grip a particle leads, or -1.
  int agentOf(int particle) const;

  //! The particle at the point of an agent's grip, or -1: it holds nothing. @throw std::out_of_range
  int particleOf(int agent) const;

  //! Where an agent is: its held point. @throw std::out_of_range
  const Pose& pose(int agent) const;

  //! The velocity with which an agent came to the present state. @throw std::out_of_range
  const Twist& twist(int agent) const;

  //! What the object exerts on an agent; nothing if it holds none. @throw std::out_of_range
  Wrench wrench(int agent) const;

  //! Quasi-static response of the object itself: see Body::response(). Zero for agents that hold nothing.
  //! @param to [agents x pointCount x 3 x 3] d point / d held point; written only where the result is VALID
  ResponseStatus response(double* to);

  //! The same by turns about each held point, for the equilibrium that the last response() found, if it was VALID.
  //! @param to [agents x pointCount x 3 x 3] m. @return false: not available
  bool turningResponse(double* to) const;

  //! What the object and its copies exert on all agents: force [N] and torque about the held point [N m].
  //! @param to [copies x agents x 6]
  void wrenches(double* to) const;

  //! Derivative of the object's wrenches with respect to each held point and turns about it, in the equilibrium that
  //! the last response() found, if it was VALID.
  //! @param to [agents x 6 x agents x 6]. @return false: not available
  bool wrenchResponse(double* to) const;

  long cycle() const { return cycle_; }
  int resetCount() const { return reset_count_; }
  double time() const { return cycle_ * clock_.cycleTime(); }  //!< [s] since the start

 private:
  //! An agent as it is now.
  struct AgentState {
    int particle;  // held, or -1
    Pose pose;
    Twist command;
    Twist twist;                         // that led to the present state
    std::vector<Vector3> displacements;  // of its copies [m]
  };

  AgentState& state(int agent) { return states_.at(static_cast<std::size_t>(agent)); }
  const AgentState& state(int agent) const { return states_.at(static_cast<std::size_t>(agent)); }
  void settle();
  std::vector<FurtherParticle> heldAround(const Pose& grip, int particle, const std::vector<int>& further) const;
  void spreadOverAgents(std::size_t numbers, double* to) const;
  std::vector<double> heldArcLengths() const;
  void restartCorrection();
  void followCorrection();

  std::vector<Agent> agents_;
  Clock clock_;
  std::unique_ptr<Body> body_;
  std::vector<AgentState> states_;
  std::unique_ptr<Body> start_body_;  // as settled
  std::vector<AgentState> start_states_;
  std::optional<ShapeCorrection> correction_;
  std::vector<double> model_points_;      // [copies x P x 3] m, scratch
  mutable std::vector<double> response_;  // of the holds, in the body's order
  bool start_changed_ = false;            // since start_body_ was settled
  Rest rest_ = Rest::MOVING;
  long cycle_ = 0;
  int reset_count_ = 0;
};

}  // namespace pbd
}  // namespace deformable_manipulation
