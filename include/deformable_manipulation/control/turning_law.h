#pragma once

#include <optional>
#include <string>
#include <vector>

#include "deformable_manipulation/control/controller_parameters.h"
#include "deformable_manipulation/control/observation.h"
#include "deformable_manipulation/control/orientation.h"

namespace deformable_manipulation {
namespace control {

//! What a grip is to do about its orientation, see TurningLaw.
struct Turn {
  Vector3 error = Vector3::Zero();    //!< [rad] rotation vector from the present to the wanted orientation
  Vector3 nominal = Vector3::Zero();  //!< [rad/s]
};

//! The nominal law for the orientations of the grips (docs/mathematics.md, "Grips that turn").
//!
//!   omega_nom = k_r log(q_wanted q^-1) + omega_leader
//!
//! FOLLOW: the wanted orientation and the place turn with the leader. FREE: the grip wants to keep its orientation from
//! the start, and the leader's turning does not matter. FIXED: nothing turns.
class TurningLaw {
 public:
  explicit TurningLaw(const ControllerParameters& parameters);

  void setParameters(const ControllerParameters& parameters);

  //! Forgets all observations.
  void reset();

  bool turns() const { return mode_ != OrientationMode::FIXED; }

  //! A clause that says why an observation cannot be used: orientations are not told, or one has leapt since the last
  //! observation. Empty: nothing is wrong.
  std::string fault(const ObservationView& observation) const;

  //! Takes in an observation without fault. Nothing where nothing turns.
  void observe(const ObservationView& observation);

  //! [A] rad/s, measured ones: told by the observation, or differences of its orientations.
  const std::vector<Vector3>& angularVelocities() const { return velocities_; }

  //! Predicts the orientations over a delay [s].
  //! @param angular_velocities [A] rad/s
  void predict(const std::vector<Vector3>& angular_velocities, double delay);

  //! A place relative to the leader, turned with it. @param predicted when commands act, else in the observed state
  Vector3 turned(const Vector3& place, bool predicted) const;

  //! The place that turned() gives in the observed state.
  Vector3 unturned(const Vector3& place) const;

  //! How a place moves [m/s] with the leader's turning.
  Vector3 velocityOf(const Vector3& place) const;

  //! The law for an agent in the predicted state. Remembers which way round it goes.
  Turn turn(int agent);

 private:
  Quaternion leaderTurn(const Quaternion& leader) const;
  Quaternion wanted(int agent) const;

  OrientationMode mode_;
  double gain_;
  int leader_;
  std::vector<Quaternion> starts_;        // [A]
  std::optional<double> time_;            // [s] of the observation
  std::vector<Quaternion> orientations_;  // [A]
  std::vector<Quaternion> predicted_;     // [A]
  std::vector<Vector3> velocities_;       // [A] rad/s
  std::vector<Vector3> moving_;           // [A] rad/s, as predicted
  std::vector<Vector3> errors_;           // [A] rad, of the last turn()
};

}  // namespace control
}  // namespace deformable_manipulation
