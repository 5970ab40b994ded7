#pragma once

#include <algorithm>
#include <vector>

#include "deformable_manipulation/control/formulation.h"

namespace deformable_manipulation {
namespace control {

//! Who is commanded by one program, among whom, and how: what every barrier has to know.
struct Team {
  int agents;                   //!< number A of all agents
  int leader;                   //!< index of the leader
  std::vector<int> assistants;  //!< indices of all assistants
  std::vector<int> commanded;   //!< indices of the M assistants whose velocities are the variables, in their order
  double max_velocity;          //!< [m/s] bound on every component
  Formulation formulation;

  //! Where the velocity of an agent is among the variables, in threes; -1: it is none.
  int columnOf(int agent) const {
    const auto found = std::find(commanded.begin(), commanded.end(), agent);
    return found == commanded.end() ? -1 : static_cast<int>(found - commanded.begin());
  }
};

}  // namespace control
}  // namespace deformable_manipulation
