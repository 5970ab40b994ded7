#include "agent_directory.h"

#include <stdexcept>

namespace deformable_manipulation {

std::string listAgents(const pbd::Simulation& simulation) {
  std::string names;
  for (const pbd::Agent& agent : simulation.agents()) {
    names += (names.empty() ? "" : ", ") + agent.name;
  }
  return names;
}

int agentNamed(const pbd::Simulation& simulation, const std::string& name) {
  for (std::size_t i = 0; i < simulation.agents().size(); ++i) {
    if (simulation.agents()[i].name == name) {
      return static_cast<int>(i);
    }
  }
  throw std::invalid_argument("there is no agent '" + name + "'; there are " + listAgents(simulation));
}

}  // namespace deformable_manipulation
