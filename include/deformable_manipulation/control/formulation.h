#pragma once

#include "deformable_manipulation/parameters/parameter_section.h"

namespace deformable_manipulation {
namespace control {

//! What the controller takes into account beyond the paper's equations.
struct Formulation {
  bool leader_velocity;     //!< in the nominal law and the collision rows
  bool obstacle_velocity;   //!< in the collision rows
  bool prediction;          //!< of the state over the delay of a cycle
  bool every_feature;       //!< a row for each near feature instead of one for the minimum
  bool anticipation;        //!< a second, softer and slower row for each feature
  bool shares;              //!< assistants share constraints instead of answering each other's velocity
  bool acceleration_limit;  //!< as a constraint
  bool relaxation;          //!< by priority, if not all limits can hold

  //! The full formulation.
  static Formulation full() { return {true, true, true, true, true, true, true, true}; }

  //! The paper's equations 2 to 13.
  static Formulation paper() { return {false, false, false, false, false, false, false, false}; }

  //! Reads the section `controller`.
  static Formulation read(const ParameterSection& controller);
};

}  // namespace control
}  // namespace deformable_manipulation
