#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "deformable_manipulation/control/observation.h"

namespace deformable_manipulation {
namespace control {

//! Which of the computed features are taken.
struct ChosenFeatures {
  const distance::Distances& distances;
  int copy = 0;                                //!< of the object
  int most = std::numeric_limits<int>::max();  //!< so many, the nearest

  const distance::Feature* first() const { return distances.features.data() + distances.offsets[copy]; }
  int count() const;
};

//! M nearest features of the object itself with their gradients.
//!
//! gradient(m, a) . v is the rate at which feature m's distance grows when agent a's held point moves with
//! the velocity v. Moving all held points together moves the object rigidly, however it is held, so the
//! gradients of all agents sum to the normal: the leader's gradient is the normal minus the others.
class Features {
 public:
  //! Starts afresh, with gradients of zero.
  void take(const ChosenFeatures& chosen, int agents);

  //! Adds one of an obstacle that stands, with its gradients by all agents.
  void add(double signed_distance, const Vector3& direction, std::int64_t of, const std::vector<Vector3>& gradients);

  //! No features.
  void clear();

  //! Sets the leader's gradients to the normals minus the gradients of the others.
  void completeLeader(int leader);

  //! Makes room for gradients by turns about the held points, zero until they are set.
  void takeTurns() { turns_.assign(gradients_.size(), Vector3::Zero()); }

  //! Gradient by turns [m/rad], if there are any.
  Vector3& turn(int feature, int agent) { return turns_[feature * agents_ + agent]; }
  const Vector3& turn(int feature, int agent) const { return turns_[feature * agents_ + agent]; }
  bool haveTurns() const { return !turns_.empty(); }

  int size() const { return static_cast<int>(distance.size()); }
  int agents() const { return agents_; }
  Vector3& gradient(int feature, int agent) { return gradients_[feature * agents_ + agent]; }
  const Vector3& gradient(int feature, int agent) const { return gradients_[feature * agents_ + agent]; }

  std::vector<double> distance;            //!< [M] m, signed, the least first
  std::vector<Vector3> normal;             //!< [M] unit vector along which the distance grows fastest
  std::vector<Vector3> obstacle_velocity;  //!< [M] m/s
  std::vector<std::int64_t> identity;      //!< [M] the same from state to state; -1: none
  std::vector<double> disturbance;         //!< [M] m/s, see DisturbanceObserver; 0 unless it is in use
  std::vector<double> parting;             //!< [M] m, along the normal, see Differences; 0 with exact gradients

 private:
  int agents_ = 0;
  std::vector<Vector3> gradients_;  // [M x A]
  std::vector<Vector3> turns_;      // [M x A] m/rad, or empty
};

}  // namespace control
}  // namespace deformable_manipulation
