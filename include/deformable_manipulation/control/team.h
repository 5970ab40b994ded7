#pragma once

#include <algorithm>
#include <vector>

#include "deformable_manipulation/control/formulation.h"

namespace deformable_manipulation {
namespace control {

//! The agents, which of them one program commands, and their bounds: what every barrier needs to know.
struct Team {
  int agents;                   //!< number A of all agents
  int leader;                   //!< index of the leader
  std::vector<int> assistants;  //!< indices of all assistants
  std::vector<int> commanded;   //!< indices of the M assistants whose velocities are the variables, in their order
  double max_velocity;          //!< [m/s] bound on every component
  Formulation formulation;
  bool turns = false;                 //!< angular velocities are variables, too: behind all velocities, in threes
  double max_angular_velocity = 0.0;  //!< [rad/s] bound on every component

  //! Number of variables.
  int variables() const { return (turns ? 6 : 3) * static_cast<int>(commanded.size()); }

  //! First of the three variables of the angular velocity of a column, if grips turn.
  int turnOf(int column) const { return 3 * (static_cast<int>(commanded.size()) + column); }

  //! Position of an agent's velocity among the variables, in threes; -1: it is not commanded.
  int columnOf(int agent) const {
    const auto found = std::find(commanded.begin(), commanded.end(), agent);
    return found == commanded.end() ? -1 : static_cast<int>(found - commanded.begin());
  }
};

}  // namespace control
}  // namespace deformable_manipulation
