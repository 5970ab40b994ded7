#pragma once

#include <memory>
#include <string>
#include <vector>

#include "deformable_manipulation/pbd/response.h"
#include "deformable_manipulation/pbd/rest.h"
#include "deformable_manipulation/pbd/rest_shapes.h"
#include "deformable_manipulation/pbd/types.h"

namespace deformable_manipulation {
namespace pbd {

//! A particle that an agent holds, and how it moves.
//!
//! An agent's grip holds one particle, or several as one rigid piece: a clamp bar, a hand. One of them is at the grip's
//! point and leads; the others keep their places relative to it.
struct HeldPoint {
  int particle;
  Hold type;
  Pose pose;            //!< in the body itself (copy 0)
  Twist twist;          //!< constant until changed
  int grip = particle;  //!< the particle that leads its grip
  Pose place = Pose();  //!< relative to the leading particle

  bool leads() const { return grip == particle; }
};

//! A particle that a grip holds besides the one at its point.
struct FurtherParticle {
  int particle;
  Pose place;  //!< relative to the pose of the grip, which it keeps
};

//! A perturbed copy of the body: the same object with one held point displaced.
struct PerturbedCopy {
  int id;                //!< never used again after the copy is removed
  int particle;          //!< held particle that is displaced, with all others of its grip
  Vector3 requested;     //!< [m] displacement asked for
  Vector3 target;        //!< [m] where it goes: the request, shortened or reversed to stay in reach
  Vector3 present;       //!< [m] where it is
  double resting = 0.0;  //!< [s] since it arrived at its target

  //! Whether the copy has arrived and calmed down. Differences to copy 0 mean nothing before.
  bool ready() const;
};

//! When a body counts as settled.
struct SettleOptions {
  double time_step;  //!< [s]
  int substeps;
  double speed_tolerance;  //!< [m/s] of the fastest particle of all copies
  double time_limit;       //!< [s] simulated
};

//! A deformable object and its perturbed copies, simulated by position-based dynamics.
//!
//! Copy 0 is the object itself; copies()[c - 1] describes copy c. All copies are held at the same
//! particles and advance together. Positions are in the fixed frame [m].
class Body {
 public:
  virtual ~Body() = default;

  //! An independent body in the same state.
  virtual std::unique_ptr<Body> clone() const = 0;

  //! The word for its kind in the scenario, see bodyMakers().
  virtual const char* kind() const = 0;

  //! The largest stretch() of an object in normal use. Beyond it the constraints are not solved, or the object is
  //! pulled apart.
  virtual double largestStretch() const = 0;

  //! Particles that can be held.
  virtual int particleCount() const = 0;

  //! Geometry points per copy (see points()).
  virtual int pointCount() const = 0;

  //! [m] Arc lengths of the geometry points from the first end, for lines: particle i is halfway between points i and
  //! i + 1. Empty: it is no line.
  virtual std::vector<double> arcLengths() const { return {}; }

  //! [m] Largest possible distance between two particles of the unstretched object.
  virtual double freeLength(int particle, int other) const = 0;

  //! [kg]
  virtual double mass() const = 0;

  //! Pose of a particle of the undeformed object, held nowhere; that of the whole object where particles have no
  //! orientation. @throw std::out_of_range
  virtual Pose undeformedPose(int particle) const = 0;

  //! Whether particles have orientations.
  virtual bool particlesTurn() const = 0;

  //! Relative error of the length (or size) of the object itself against the unstretched one.
  virtual double stretch() const = 0;

  //! If substeps of this length [s] cannot keep the material's stiffness or viscosity: sentences about what results and
  //! about what helps. Otherwise empty.
  virtual std::string softness(double time_step, int substeps) const;

  //! Changes the material while running; shape and motion stay.
  //! @throw ParameterError with every parameter that the object does not have or that is out of range;
  //! nothing changes then.
  virtual void setMaterial(const std::vector<MaterialParameter>& parameters) = 0;

  // Holding ------------------------------------------------------------------------------------

  //! Holds a particle where it is now.
  //! @throw std::out_of_range if there is no such particle
  //! @throw std::invalid_argument if it is held already
  void hold(int particle, Hold type);

  //! Holds a particle and puts it at a pose.
  //! @throw std::out_of_range if there is no such particle
  //! @throw std::invalid_argument if it is held already, or the pose is not finite or not of norm 1.
  void hold(int particle, Hold type, const Pose& pose);

  //! Holds several particles by one grip, as one rigid piece, which is put at a pose.
  //! @param particle  at the grip's point; it stands for the grip wherever a held particle is asked for
  //! @throw std::out_of_range if there is no such particle
  //! @throw std::invalid_argument if one is held already or given twice, or a pose is not finite or not of norm 1.
  void hold(int particle, const std::vector<FurtherParticle>& further, Hold type, const Pose& pose);

  //! Lets a grip go; copies that displace it are removed.
  //! @throw std::invalid_argument if the particle is not held, or follows another one.
  void release(int particle);

  //! Sets the velocity with which a held particle moves from now on.
  //! @throw std::invalid_argument if the particle is not held or follows another one, or the twist is not finite.
  void setTwist(int particle, const Twist& twist);

  //! Puts a held particle at a pose at once, for agents whose pose is given by others.
  //! @throw std::invalid_argument as for hold().
  void setPose(int particle, const Pose& pose);

  //! Sets the constant velocity with which a held particle is at a pose after a duration [s], by the shortest turn.
  //! It keeps that velocity until it is changed.
  //! @throw std::invalid_argument as setPose(), or if the duration is not finite and positive.
  void moveTo(int particle, const Pose& pose, double duration);

  //! All held particles, in order. Grips are in the order of the particles that lead them.
  const std::vector<HeldPoint>& holds() const { return holds_; }

  //! The number of grips: of held particles that lead.
  int gripCount() const;

  //! @throw std::invalid_argument if the particle is not held.
  const HeldPoint& held(int particle) const;

  //! What the object, or a copy of it, exerts on the agent that holds this particle, from the last substep; the
  //! inertia of the held particle itself is left out.
  //! @throw std::invalid_argument if the particle is not held.
  virtual Wrench wrench(int particle, int copy = 0) const = 0;

  //! The same of all particles of a grip together, about its point.
  //! @throw std::invalid_argument if the particle is not held.
  Wrench gripWrench(int particle, int copy = 0) const;

  //! Quasi-static response: the exact derivative of the points of the object itself, in the equilibrium
  //! between its holds, with respect to each grip's point. Starts from what the last call found.
  //! @param to [grips x pointCount x 3 x 3] d point / d held point; written only where the result is VALID
  virtual ResponseStatus response(double* to);

  //! Of the equilibrium that the last response() found, if it was VALID: derivative of the points with respect to turns
  //! about each grip's point, [grips x pointCount x 3 x 3] m.
  //! @return false: not available
  virtual bool turningResponse(double* to) const;

  //! The same of the wrenches at the grips, with respect to each grip's point and turns about it,
  //! [grips x 6 x grips x 6]. @return false: not available
  virtual bool wrenchResponse(double* to) const;

  //! What tells how the object rests if it is held elsewhere; null: there is none for objects of this kind.
  //! @param agents where they hold the object, with the orientations that they keep; the body itself is held nowhere
  virtual std::unique_ptr<RestShapes> restShapes(const std::vector<HeldPoint>& agents) const;

  // Copies -------------------------------------------------------------------------------------

  //! Adds a copy; it starts as the object is now and moves to its displacement.
  //! @return the copy's id
  //! @throw std::invalid_argument if the particle is not held or follows another one, or the displacement is zero, not
  //! finite or longer than the object.
  int addCopy(int particle, const Vector3& displacement);

  //! @throw std::invalid_argument if there is no such copy.
  void removeCopy(int id);

  const std::vector<PerturbedCopy>& copies() const { return copies_; }

  //! Copy 0 and the perturbed copies.
  int copyCount() const { return static_cast<int>(copies_.size()) + 1; }

  //! Where the held point of a copy is.
  Vector3 heldPosition(const HeldPoint& held, int copy) const;

  // Time ---------------------------------------------------------------------------------------

  //! Places every copy, at rest and undisplaced, on a curve of the right length between the held points.
  virtual void layOut() = 0;

  //! Puts the object and its copies, undisplaced, into a measured state. Holds stay where they are.
  //! @param points  [pointCount x 3] m, as near to the unstretched object as they were measured
  //! @param velocities  [pointCount x 3] m/s
  //! @throw std::invalid_argument if a number is not finite, or neighbouring points of a line coincide.
  void setState(const double* points, const double* velocities);

  //! Advances all copies by a time step [s].
  //! @throw ParameterError if the time step is not finite and positive or substeps < 1; nothing
  //! changes then.
  //! @throw NonFiniteState if the state is no longer finite.
  void step(double time_step, int substeps);

  //! Advances with the held points at rest until nothing moves any more. The damping of the object does not matter: it
  //! settles with a damping that brings it to rest soon, which does not change the shape at rest.
  //! @return whether it settled within the time limit
  //! @throw ParameterError as for step(), or if tolerance or time limit are not finite or negative
  //! @throw NonFiniteState
  bool settle(const SettleOptions& options);

  //! Does the same, then pushes the object out of unstable balances. If the object comes back after a small push, its
  //! state is that of settle().
  //! @throw ParameterError as settle()
  //! @throw NonFiniteState
  Rest settleStably(const SettleOptions& options);

  // Reading ------------------------------------------------------------------------------------

  //! Geometry points of all copies, [copyCount x pointCount x 3] numbers.
  virtual void points(double* to) const = 0;

  //! Pose of a particle of the object itself. @throw std::out_of_range
  virtual Pose pose(int particle) const = 0;

  //! Particle positions of one copy, [particleCount x 3].
  virtual void positions(int copy, double* to) const = 0;

  //! Particle velocities of one copy, [particleCount x 3] m/s.
  virtual void velocities(int copy, double* to) const = 0;

  //! Particle orientations of one copy, [particleCount x 4] x y z w; false if particles have none.
  virtual bool orientations(int copy, double* to) const = 0;

 protected:
  Body() = default;
  Body(const Body&) = default;
  Body& operator=(const Body&) = default;

  //! The set of holds or the kind of one has changed.
  virtual void holdsChanged() = 0;

  //! Makes room for copyCount() copies.
  virtual void resizeCopies() = 0;

  //! Overwrites the state of one copy with that of another.
  virtual void assignCopy(int to, int from) = 0;

  //! Called before the substeps of a step, with the holds' twists final.
  virtual void beginStep(double h) = 0;

  //! One substep of h [s]; holds() and copies() are where they are at its end. A body may note that
  //! and do several substeps at once, at the latest in endStep().
  virtual void substep() = 0;

  //! Called after the substeps of a step.
  virtual void endStep() {}

  //! First particle of a copy whose state is not finite, or -1.
  virtual int firstNonFinite(int copy) const = 0;

  //! [m/s] of the fastest particle of all copies, including how fast turning moves points of a particle.
  virtual double highestSpeed() const = 0;

  //! Sets all velocities to zero.
  virtual void stop() = 0;

  //! setState() of the object itself.
  virtual void placeState(const double* points, const double* velocities) = 0;

  //! Moves a particle of the object itself.
  virtual void displace(int particle, const Vector3& by) = 0;

  //! What takes energy from motion: first the damping [1/s], which settling needs, then what it does without.
  virtual std::vector<MaterialParameter> dampings() const = 0;

  void requireParticle(int particle) const;

 private:
  HeldPoint& findHeld(int particle);
  const HeldPoint& leading(int particle) const;
  void requireFree(int particle) const;
  void advanceHolds(double h);
  void placeFollowers();
  void moveFollowers();
  template <typename Settling>
  auto quicklyDamped(const SettleOptions& options, Settling settling);
  bool settleAsDamped(const SettleOptions& options);
  Rest pushOffBalance(const SettleOptions& options);
  bool leavesItsShape(const SettleOptions& options) const;
  double extent() const;
  void push(const SettleOptions& options);
  bool isHeld(int particle) const;
  void retargetCopies();
  void restartCopy(int copy);
  void advanceCopies(double h);
  bool inReach(const PerturbedCopy& copy, const Vector3& displacement, double margin) const;
  void checkFinite() const;

  std::vector<HeldPoint> holds_;
  std::vector<PerturbedCopy> copies_;
  int next_id_ = 1;
  long steps_ = 0;
};

}  // namespace pbd
}  // namespace deformable_manipulation
