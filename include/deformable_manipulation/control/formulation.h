#pragma once

namespace deformable_manipulation {
namespace control {

//! What the controller takes into account beyond the paper's equations; the defaults are all of it.
struct Formulation {
  bool leader_velocity = true;     //!< in the nominal law and the collision rows
  bool obstacle_velocity = true;   //!< in the collision rows
  bool prediction = true;          //!< of the state over the delay of a cycle
  bool every_feature = true;       //!< a row for each near feature instead of one for the minimum
  bool anticipation = true;        //!< a second, softer and slower row for each feature
  bool shares = true;              //!< assistants share constraints instead of answering each other's velocity
  bool acceleration_limit = true;  //!< as a constraint
  bool relaxation = true;          //!< by priority, where not all limits can hold

  //! The paper's equations 2 to 13.
  static Formulation paper() { return {false, false, false, false, false, false, false, false}; }
};

}  // namespace control
}  // namespace deformable_manipulation
