#pragma once

#include <string>

#include "deformable_manipulation/pbd/simulation.h"

namespace deformable_manipulation {

//! "leader, assistant_1"
std::string listAgents(const pbd::Simulation& simulation);

//! Index of the agent of a name. @throw std::invalid_argument, which lists the names that there are
int agentNamed(const pbd::Simulation& simulation, const std::string& name);

}  // namespace deformable_manipulation
