#include "deformable_manipulation/pbd/rod_rest_shapes.h"

#include <algorithm>
#include <cmath>

namespace deformable_manipulation {
namespace pbd {
namespace {

// The error left is about the square of the tolerance [rad]. From cycle to cycle a step or two are enough; the first
// search for a shape may need more.
constexpr EquilibriumOptions kLookingAhead{1e-4, 20};

constexpr double kFar = 0.1;  // of the length

}  // namespace

RodRestShapes::RodRestShapes(const Rod& rod, const std::vector<HeldPoint>& agents)
    : rod_(static_cast<Rod*>(rod.clone().release())) {
  for (const HeldPoint& agent : agents) {
    rod_->hold(agent.particle, agent.type, agent.pose);
  }
  for (const HeldPoint& held : rod_->holds()) {
    const auto holds = [&](const HeldPoint& agent) { return agent.particle == held.particle; };
    agent_of_hold_.push_back(static_cast<int>(std::find_if(agents.begin(), agents.end(), holds) - agents.begin()));
  }
  rod_->layOut();
}

void RodRestShapes::placePresent(const double* points) {
  present_.assign(points, points + 3 * pointCount());
  rod_->setShape(points);
}

void RodRestShapes::find(const std::vector<Vector3>& held) {
  const std::size_t holds = agent_of_hold_.size();
  held_.resize(held.size());
  for (std::size_t i = 0; i < held.size(); ++i) {
    held_[i] = held[i - i % holds + agent_of_hold_[i % holds]];
  }
  search();
  if (isFarFromPresent()) {
    equilibrium_ = RodEquilibrium();
    search();
  }
}

void RodRestShapes::search() {
  EquilibriumOptions options = kLookingAhead;
  options.turned = turns_;
  equilibrium_.updateElsewhere(*rod_, held_, options);
}

void RodRestShapes::setOrientations(const std::vector<Quaternion>& orientations) {
  turns_ = true;
  for (std::size_t i = 0; i < agent_of_hold_.size(); ++i) {
    const HeldPoint& held = rod_->holds()[i];
    rod_->setPose(held.particle, {held.pose.position, orientations[agent_of_hold_[i]]});
  }
}

//! Whether the first shape lies farther from the present one than its holds have moved: the object has taken another
//! of its equilibria since.
bool RodRestShapes::isFarFromPresent() const {
  if (!known(0)) {
    return false;
  }
  std::vector<double> shape(present_.size());
  readPoints(0, shape.data());
  double most = 0.0;
  for (std::size_t i = 0; i < rod_->holds().size(); ++i) {
    const Vector3 before = rod_->pose(rod_->holds()[i].particle).position;
    most = std::max(most, (held_[i] - before).norm());
  }
  double farthest = 0.0;
  for (std::size_t i = 0; i < shape.size(); ++i) {
    farthest = std::max(farthest, std::abs(shape[i] - present_[i]));
  }
  return farthest > 2.0 * most + kFar * rod_->parameters().length;
}

bool RodRestShapes::known(int shape) const { return equilibrium_.status(shape) == ResponseStatus::VALID; }

void RodRestShapes::response(int shape, double* to) const {
  const std::size_t numbers = 9 * static_cast<std::size_t>(pointCount());
  std::vector<double> of_holds(numbers * agent_of_hold_.size());
  equilibrium_.response(shape, of_holds.data());
  for (std::size_t i = 0; i < agent_of_hold_.size(); ++i) {
    std::copy_n(&of_holds[numbers * i], numbers, to + numbers * agent_of_hold_[i]);
  }
}

}  // namespace pbd
}  // namespace deformable_manipulation
