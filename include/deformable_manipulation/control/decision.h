#pragma once

#include <limits>
#include <vector>

#include "deformable_manipulation/control/detour.h"
#include "deformable_manipulation/control/status.h"
#include "deformable_manipulation/pbd/types.h"

namespace deformable_manipulation {
namespace control {

using pbd::Vector3;

constexpr double UNKNOWN = std::numeric_limits<double>::quiet_NaN();

//! What an assistant's controller decided in one cycle, and why.
//!
//! The command is always finite. Everything else is NaN if it is not known, for example while waiting for valid input.
struct Decision {
  Status status = Status::WAITING;
  bool enabled = true;
  bool coordinated = false;                              //!< all assistants were decided together; false: shares
  DetourState detour = DetourState::NONE;                //!< whether it goes another way than straight to its place
  bool lacks_copies = false;                             //!< waits because its gradients are not known
  Vector3 command = Vector3::Zero();                     //!< [m/s] of the own held point
  Vector3 nominal = Vector3::Constant(UNKNOWN);          //!< [m/s]
  Vector3 angular_command = Vector3::Zero();             //!< [rad/s] of the own grip
  Vector3 angular_nominal = Vector3::Constant(UNKNOWN);  //!< [rad/s] NaN: grips do not turn
  Vector3 orientation_error =
      Vector3::Constant(UNKNOWN);                 //!< [rad] rotation vector to the wanted orientation, likewise
  Vector3 position = Vector3::Constant(UNKNOWN);  //!< [m] own held point
  Vector3 target = Vector3::Constant(UNKNOWN);    //!< [m] leader plus reference
  double distance = UNKNOWN;                      //!< [m] signed minimum of the object; infinite: no obstacle
  std::vector<double> h;                          //!< [m] the lowest of each barrier, in the team's order
  Vector3 jacobian = Vector3::Constant(UNKNOWN);  //!< [1] d distance / d position
  bool exact_jacobian = false;                    //!< from the equilibrium; false: from perturbed copies
  double leader_drift = UNKNOWN;                  //!< [m/s] change of the distance by the leader's motion
  int rows = 0;                                   //!< of the barriers
  std::vector<double> slack;                      //!< [m/s] by how much the rows of each barrier are missed at most
  double solve_time = 0.0;                        //!< [s] of the safety filter

  //! Resets everything, for a number of barriers; keeps its memory.
  void clear(int barriers);
};

}  // namespace control
}  // namespace deformable_manipulation
