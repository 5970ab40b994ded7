#pragma once

#include <string>
#include <vector>

#include "deformable_manipulation/control/safety_filter.h"
#include "deformable_manipulation/control/team.h"
#include "deformable_manipulation/parameters/parameter_section.h"

namespace deformable_manipulation {
namespace control {

using pbd::Vector3;

//! What the leader is expected to do, see LeaderForecast.
enum class ExpectedLeader {
  FADING,     //!< goes on with a velocity that fades
  ANNOUNCED,  //!< does what it announces, as far as that has been true lately
  KNOWN       //!< does what it announces
};

//! What the assistants' grips do about their orientations, see TurningLaw.
enum class OrientationMode {
  FIXED,   //!< they keep it
  FOLLOW,  //!< they turn with the leader
  FREE     //!< they turn where that serves the barriers
};

//! How far a controller looks ahead, see Horizon.
struct HorizonParameters {
  double length;  //!< [s] 0: not at all
  int nodes;      //!< number N of times at which it looks
  ExpectedLeader leader;
  double leader_fade;     //!< [s] time constant with which the leader's velocity is expected to fade
  double leader_doubt;    //!< part of the leader's way at its recent speed by which distances may be smaller
  double leader_memory;   //!< [s] time constant with which the leader's recent speed is forgotten
  double obstacle_doubt;  //!< part of a measured obstacle's expected way by which it may come nearer
  Vector3 weights;        //!< cost of departing from the nominal velocity per axis

  //! Reads the section `controller.horizon`.
  static HorizonParameters read(const ParameterSection& horizon);
};

//! The parameters of a controller. Only the values are here; ranges, defaults and meanings of the keys are declared in
//! Python, see docs/parameters.md.
struct ControllerParameters {
  std::vector<Vector3> references;  //!< [M] m, places to keep relative to the leader
  std::vector<Vector3> places;      //!< [A] m, the same of all agents
  double cycle_time;                //!< [s]
  bool safety;                      //!< false: the nominal velocity within its limits
  double gain;                      //!< [1/s]
  Vector3 weights;                  //!< cost of deviating from the nominal velocity, per axis
  double max_velocity;              //!< [m/s] of every component
  double max_acceleration;          //!< [m/s^2] of every component
  double max_jerk;                  //!< [m/s^3] of every component
  OrientationMode orientation;
  double turning_gain;                        //!< [1/s]
  Vector3 turning_weights;                    //!< cost of deviating from the nominal angular velocity, per axis
  double max_angular_acceleration;            //!< [rad/s^2] of every component
  std::vector<pbd::Quaternion> orientations;  //!< [A] at the start
  double smoothing;                           //!< [s] time constant of a deviation from the nominal velocity; 0: none
  double disturbance_filter;                  //!< [s] time constant of the disturbance observer; 0: none
  double timeout;                             //!< [s] if a state is older than the last by more, time was set back
  bool exact_gradients;                       //!< from the response, where it is known
  HorizonParameters horizon;
  Team team;                          //!< whose velocities are decided together, and who else there is
  std::vector<int> own;               //!< numbers of those among them whom this controller commands
  std::vector<std::string> barriers;  //!< names of the barriers in use, in their order
  Priority priority;                  //!< of the barriers, by their numbers in that order
  ParameterValue values;              //!< the section `controller`, of which the barriers read theirs

  //! Reads the section `controller` and its team.
  static ControllerParameters read(const ParameterSection& controller, const ParameterSection& team);
};

}  // namespace control
}  // namespace deformable_manipulation
