#pragma once

#include <string>
#include <vector>

#include "deformable_manipulation/pbd/types.h"

namespace deformable_manipulation {
namespace control {

using pbd::Vector3;

//! M nearest features of the object's copies; those of copy c are offsets[c] to offsets[c + 1] - 1, the
//! nearest first. A view: the arrays belong to someone else.
struct DistancesView {
  const double* minimum = nullptr;            //!< [copies] m; infinite where a copy has no feature
  const int* offsets = nullptr;               //!< [copies + 1]
  const double* distance = nullptr;           //!< [M] m, signed
  const double* normal = nullptr;             //!< [M x 3] unit vector along which the distance grows fastest
  const int* vertices = nullptr;              //!< [M x 3] points that the feature's material point is made of
  const double* weights = nullptr;            //!< [M x 3] of those points
  const double* obstacle_velocity = nullptr;  //!< [M x 3] m/s
  int features = 0;                           //!< M

  Vector3 normalOf(int feature) const { return Eigen::Map<const Vector3>(normal + 3 * feature); }
  Vector3 obstacleVelocityOf(int feature) const { return Eigen::Map<const Vector3>(obstacle_velocity + 3 * feature); }
};

//! What an assistant's controller sees of one state: A agents, C copies of the object with P points each.
//!
//! Copy 0 is the object itself. All in the fixed frame and of one time. A view: see DistancesView.
struct ObservationView {
  double time = 0.0;      //!< [s] of the state
  double lateness = 0.0;  //!< [s] by which commands that answer it act later than a cycle after it
  int agents = 0;
  int copies = 0;
  int points = 0;
  const double* positions = nullptr;      //!< [A x 3] m, held points
  const double* velocities = nullptr;     //!< [A x 3] m/s, of the held points; null: to be found from the positions
  const double* coordinates = nullptr;    //!< [C x P x 3] m, geometry points of each copy
  const int* displaced_agents = nullptr;  //!< [C] whose held point is displaced; -1: none
  const double* displacements = nullptr;  //!< [C x 3] m, present displacement of that held point
  const bool* ready = nullptr;            //!< [C] false while a copy still moves to its displacement
  const double* sensitivities = nullptr;  //!< [A x P x 3 x 3] d point / d held point at rest; null: not known
  DistancesView distances;

  Eigen::Map<const Vector3> position(int agent) const { return Eigen::Map<const Vector3>(positions + 3 * agent); }
};

//! What makes an observation unusable, as a clause that names the field, or an empty string: a number that is
//! not finite, or an index out of range.
std::string findFault(const ObservationView& observation);

}  // namespace control
}  // namespace deformable_manipulation
