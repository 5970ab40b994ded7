#include "deformable_manipulation/pbd/simulation.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

#include "deformable_manipulation/pbd/errors.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

void requireAgents(const Body& body, const std::vector<Agent>& agents, ParameterCheck& check) {
  check.require(!agents.empty(), "agents", "none", "at least one agent");
  std::set<int> particles;
  std::set<std::string> names;
  for (const Agent& agent : agents) {
    const std::string key = "agents." + agent.name;
    check.require(names.insert(agent.name).second, key, agent.name, "a name of its own");
    check.require(agent.particle >= 0 && agent.particle < body.particleCount(), key + ".particle", agent.particle,
                  "a particle of the object, 0 to " + std::to_string(body.particleCount() - 1));
    check.require(particles.insert(agent.particle).second, key + ".particle", agent.particle,
                  "a particle that no other agent holds");
    check.require(agent.start.position.allFinite(), key + ".start", "not finite", "three finite numbers [m]");
    check.require(std::abs(agent.start.orientation.norm() - 1.0) < 1e-6, key + ".orientation",
                  agent.start.orientation.norm(), "a quaternion of norm 1");
  }
}

}  // namespace

void Clock::check() const {
  ParameterCheck check;
  check.positive("time_step", time_step, "[s]");
  check.require(substeps >= 1, "substeps", substeps, "a whole number >= 1");
  check.require(steps_per_cycle >= 1, "steps_per_cycle", steps_per_cycle, "a whole number >= 1");
  check.throwIfAny();
}

Simulation::Simulation(std::unique_ptr<Body> body, std::vector<Agent> agents,
                       const std::vector<Perturbation>& perturbations, const Clock& clock)
    : agents_(std::move(agents)), clock_(clock), body_(std::move(body)), twists_(agents_.size()) {
  clock_.check();
  ParameterCheck check;
  requireAgents(*body_, agents_, check);
  check.throwIfAny();
  for (const Agent& agent : agents_) {
    body_->hold(agent.particle, agent.hold, agent.start);
  }
  body_->layOut();
  for (const Perturbation& perturbation : perturbations) {
    addPerturbation(perturbation);
  }
  SettleOptions options;
  options.time_step = clock_.time_step;
  options.substeps = clock_.substeps;
  settled_ = body_->settle(options);
  start_ = body_->clone();
}

const Agent& Simulation::agent(int index) const { return agents_.at(static_cast<std::size_t>(index)); }

void Simulation::setCommand(int index, const Twist& twist) { body_->setTwist(agent(index).particle, twist); }

void Simulation::advance() {
  for (std::size_t i = 0; i < agents_.size(); ++i) {
    twists_[i] = body_->held(agents_[i].particle).twist;
  }
  for (int step = 0; step < clock_.steps_per_cycle; ++step) {
    body_->step(clock_.time_step, clock_.substeps);
  }
  ++cycle_;
}

void Simulation::reset() {
  body_ = start_->clone();
  twists_.assign(agents_.size(), Twist());
  cycle_ = 0;
  ++reset_count_;
}

int Simulation::addPerturbation(const Perturbation& perturbation) {
  return body_->addCopy(agent(perturbation.agent).particle, perturbation.displacement);
}

void Simulation::removePerturbations(const std::vector<int>& ids) {
  for (int id : ids) {
    body_->removeCopy(id);
  }
}

void Simulation::clearPerturbations(int index) {
  const int particle = agent(index).particle;
  std::vector<int> ids;
  for (const PerturbedCopy& copy : body_->copies()) {
    if (copy.particle == particle) {
      ids.push_back(copy.id);
    }
  }
  removePerturbations(ids);
}

int Simulation::agentOf(int particle) const {
  const auto found = std::find_if(agents_.begin(), agents_.end(),
                                  [particle](const Agent& agent) { return agent.particle == particle; });
  return found == agents_.end() ? -1 : static_cast<int>(found - agents_.begin());
}

const HeldPoint& Simulation::held(int index) const { return body_->held(agent(index).particle); }

const Twist& Simulation::twist(int index) const { return twists_.at(static_cast<std::size_t>(index)); }

Wrench Simulation::wrench(int index) const { return body_->wrench(agent(index).particle); }

}  // namespace pbd
}  // namespace deformable_manipulation
