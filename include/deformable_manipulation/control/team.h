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

  //! Position of an agent's velocity among the variables, in threes; -1: it is not commanded.
  int columnOf(int agent) const {
    const auto found = std::find(commanded.begin(), commanded.end(), agent);
    return found == commanded.end() ? -1 : static_cast<int>(found - commanded.begin());
  }
};

}  // namespace control
}  // namespace deformable_manipulation
