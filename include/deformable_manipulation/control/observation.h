#pragma once

#include <string>
#include <vector>

#include "deformable_manipulation/control/announcement.h"
#include "deformable_manipulation/distance/features.h"
#include "deformable_manipulation/pbd/types.h"

namespace deformable_manipulation {
namespace control {

using pbd::Vector3;

//! What an assistant's controller sees of one state: A agents, C copies of the object with P points each.
//!
//! Copy 0 is the object itself. Everything is in the fixed frame and belongs to one time. This is a view: it does not
//! own what it points to.
struct ObservationView {
  double time = 0.0;      //!< [s] of the state
  double lateness = 0.0;  //!< [s] delay, beyond one cycle, until commands that answer it act
  int agents = 0;
  int copies = 0;
  int points = 0;
  const double* positions = nullptr;     //!< [A x 3] m, held points
  const double* velocities = nullptr;    //!< [A x 3] m/s, of the held points; null: to be found from the positions
  const double* orientations = nullptr;  //!< [A x 4] x, y, z, w of the grips; null: not told
  const double* angular_velocities = nullptr;  //!< [A x 3] rad/s, of the grips; null: to be found from orientations
  const double* coordinates = nullptr;         //!< [C x P x 3] m, geometry points of each copy
  const double* correction = nullptr;     //!< [P x 3] m, how measured points have moved those of the model; null: not
  const int* displaced_agents = nullptr;  //!< [C] whose held point is displaced; -1: none
  const double* displacements = nullptr;  //!< [C x 3] m, present displacement of that held point
  const bool* ready = nullptr;            //!< [C] false while a copy still moves to its displacement
  const double* sensitivities = nullptr;  //!< [A x P x 3 x 3] d point / d held point at rest; null: not known
  const double* turning_sensitivities = nullptr;  //!< [A x P x 3 x 3] d point / d turn; null: not known
  const double* wrenches = nullptr;  //!< [C x A x 6] N, N m: what each copy exerts on the agents; null: not told
  const double* wrench_sensitivities = nullptr;    //!< [A x 6 x A x 6] d wrench / d held point, turn; null: not known
  const distance::Distances* distances = nullptr;  //!< of all C copies
  int obstacles = 0;                               //!< K that move
  const double* obstacle_poses = nullptr;          //!< [K x 7] m, quaternion x, y, z, w; null: not told
  AnnouncementView announcement;                   //!< where the leader will be; without effect where it has a fault

  Eigen::Map<const Vector3> position(int agent) const { return Eigen::Map<const Vector3>(positions + 3 * agent); }
};

//! [A] Of the grips, if they are told.
std::vector<pbd::Quaternion> orientationsOf(const ObservationView& observation);

//! What makes an observation unusable, as a clause that names the field, or an empty string: a number that is
//! not finite, or an index out of range.
std::string findFault(const ObservationView& observation);

}  // namespace control
}  // namespace deformable_manipulation
