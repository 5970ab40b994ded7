#include "deformable_manipulation/pbd/rod_rest_shapes.h"

#include <algorithm>

namespace deformable_manipulation {
namespace pbd {
namespace {

// A few steps follow what changes from cycle to cycle. What needs more is found in the cycles that follow, or is no
// shape that the agents could rely on.
constexpr EquilibriumOptions kLookingAhead{1e-4, 6};

}  // namespace

RodRestShapes::RodRestShapes(const Rod& rod, const std::vector<HeldPoint>& agents)
    : rod_(static_cast<Rod*>(rod.clone().release())) {
  for (const HeldPoint& agent : agents) {
    rod_->hold(agent.particle, agent.type, agent.pose);
  }
  for (const HeldPoint& held : rod_->holds()) {
    const auto holds = [&](const HeldPoint& agent) { return agent.particle == held.particle; };
    agent_of_hold_.push_back(
        static_cast<int>(std::find_if(agents.begin(), agents.end(), holds) - agents.begin()));
  }
  rod_->layOut();
}

void RodRestShapes::setPresent(const double* points) { rod_->setShape(points); }

void RodRestShapes::find(const std::vector<Vector3>& held) {
  const std::size_t holds = agent_of_hold_.size();
  held_.resize(held.size());
  for (std::size_t i = 0; i < held.size(); ++i) {
    held_[i] = held[i - i % holds + agent_of_hold_[i % holds]];
  }
  equilibrium_.updateElsewhere(*rod_, held_, kLookingAhead);
}

bool RodRestShapes::known(int shape) const { return equilibrium_.status(shape) == ResponseStatus::VALID; }

void RodRestShapes::response(int shape, double* to) const {
  const std::size_t numbers = 9 * static_cast<std::size_t>(pointCount());
  response_.resize(numbers * agent_of_hold_.size());
  equilibrium_.response(shape, response_.data());
  for (std::size_t i = 0; i < agent_of_hold_.size(); ++i) {
    std::copy_n(&response_[numbers * i], numbers, to + numbers * agent_of_hold_[i]);
  }
}

}  // namespace pbd
}  // namespace deformable_manipulation
