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

constexpr double kRestSpeed = 1e-4;   // m/s, of the fastest particle of a settled object
constexpr double kSettleTime = 60.0;  // s, simulated, after which settling is given up

// An object that did not settle because it swings is a start; one that has come apart is none.
constexpr double kLargestStretch = 0.05;

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
    check.require(agent.further.empty() || agent.hold == Hold::CLAMPED, key + ".hold", "pinned",
                  "clamped: several particles are held with the orientation of their grip");
    for (int particle : agent.further) {
      check.require(particle >= 0 && particle < body.particleCount(), key + ".further_particles", particle,
                    "a particle of the object, 0 to " + std::to_string(body.particleCount() - 1));
      check.require(particles.insert(particle).second, key + ".further_particles", particle,
                    "a particle that no agent holds yet");
    }
    check.require(agent.start.position.allFinite(), key + ".start", "not finite", "three finite numbers [m]");
    check.require(std::abs(agent.start.orientation.norm() - 1.0) < 1e-6, key + ".orientation",
                  agent.start.orientation.norm(), "a quaternion of norm 1");
  }
}

//! How particles of the undeformed object lie relative to one of them, whose orientation the grip has.
std::vector<FurtherParticle> placesAround(const Body& body, int particle, const std::vector<int>& further) {
  const Pose from = body.undeformedPose(particle);
  std::vector<FurtherParticle> places;
  for (int each : further) {
    const Pose pose = body.undeformedPose(each);
    places.push_back({each,
                      {from.orientation.conjugate() * (pose.position - from.position),
                       (from.orientation.conjugate() * pose.orientation).normalized()}});
  }
  return places;
}

std::vector<int> idsOf(const Body& body) {
  std::vector<int> ids;
  for (const PerturbedCopy& copy : body.copies()) {
    ids.push_back(copy.id);
  }
  return ids;
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
    : agents_(std::move(agents)), clock_(clock), body_(std::move(body)) {
  clock_.check();
  ParameterCheck check;
  requireAgents(*body_, agents_, check);
  check.throwIfAny();
  for (const Agent& agent : agents_) {
    body_->hold(agent.particle, placesAround(*body_, agent.particle, agent.further), agent.hold, agent.start);
    states_.push_back({agent.particle, agent.start, Twist(), Twist(), {}});
  }
  body_->layOut();
  for (const Perturbation& perturbation : perturbations) {
    addPerturbation(perturbation);
  }
  settle();
  check.require(rest_ != Rest::MOVING || std::abs(body_->stretch()) < kLargestStretch, "simulation.time_step",
                clock_.time_step,
                "small enough for the object to settle: it is " + std::to_string(100.0 * body_->stretch()) +
                    " % too long after a minute; more simulation.substeps help, and so do fewer, larger elements");
  check.throwIfAny();
  start_body_ = body_->clone();
  start_states_ = states_;
}

void Simulation::settle() { rest_ = body_->settleStably({clock_.time_step, clock_.substeps, kRestSpeed, kSettleTime}); }

void Simulation::setCommand(int agent, const Twist& twist) {
  if (!twist.linear.allFinite() || !twist.angular.allFinite()) {
    throw std::invalid_argument("the velocity of agent " + agents_.at(static_cast<std::size_t>(agent)).name +
                                " must be finite");
  }
  state(agent).command = twist;
}

void Simulation::advance() {
  for (const AgentState& state : states_) {
    if (state.particle >= 0) {
      body_->setTwist(state.particle, state.command);
    }
  }
  for (int step = 0; step < clock_.steps_per_cycle; ++step) {
    body_->step(clock_.time_step, clock_.substeps);
  }
  for (AgentState& state : states_) {
    state.pose =
        state.particle >= 0 ? body_->held(state.particle).pose : moved(state.pose, state.command, clock_.cycleTime());
    state.twist = state.command;
  }
  ++cycle_;
  followCorrection();
}

void Simulation::correct(const CorrectionParameters& parameters) {
  ParameterCheck check;
  check.require(!body_->arcLengths().empty(), "correction", body_->kind(), "absent for such objects: only for rods");
  check.throwIfAny();
  correction_.emplace(parameters, body_->arcLengths(), heldArcLengths());
  followCorrection();
}

std::string Simulation::measure(double time, const std::vector<MeasuredPoint>& points) {
  if (!correction_) {
    throw std::logic_error("nothing is corrected");
  }
  return correction_->measure(time, points);
}

void Simulation::points(double* to) const {
  body_->points(to);
  if (!correction_) {
    return;
  }
  const std::vector<double>& field = correction_->field();
  const Eigen::Map<const Eigen::ArrayXd> by(field.data(), static_cast<Eigen::Index>(field.size()));
  for (int copy = 0; copy < body_->copyCount(); ++copy, to += field.size()) {
    Eigen::Map<Eigen::ArrayXd>(to, by.size()) += by;
  }
}

std::vector<double> Simulation::heldArcLengths() const {
  const std::vector<double> arc_lengths = body_->arcLengths();
  std::vector<double> held;
  for (const HeldPoint& point : body_->holds()) {
    held.push_back(0.5 * (arc_lengths[point.particle] + arc_lengths[point.particle + 1]));
  }
  return held;
}

void Simulation::restartCorrection() {
  if (correction_) {
    correction_->setHolds(heldArcLengths());
    followCorrection();
  }
}

void Simulation::followCorrection() {
  if (correction_) {
    model_points_.resize(3 * static_cast<std::size_t>(body_->pointCount()) * body_->copyCount());
    body_->points(model_points_.data());
    correction_->advance(time(), model_points_.data());
  }
}

void Simulation::reset() {
  body_ = start_body_->clone();
  states_ = start_states_;
  if (start_changed_) {
    settle();
    start_body_ = body_->clone();
    start_changed_ = false;
  }
  cycle_ = 0;
  ++reset_count_;
  restartCorrection();
}

int Simulation::addPerturbation(const Perturbation& perturbation) {
  AgentState& displaced = state(perturbation.agent);
  const int id = body_->addCopy(displaced.particle, perturbation.displacement);
  displaced.displacements.push_back(perturbation.displacement);
  return id;
}

void Simulation::removePerturbations(const std::vector<int>& ids) {
  for (int id : ids) {
    const std::vector<PerturbedCopy>& copies = body_->copies();
    const auto copy = std::find_if(copies.begin(), copies.end(), [id](const PerturbedCopy& c) { return c.id == id; });
    if (copy != copies.end()) {
      std::vector<Vector3>& displacements = state(agentOf(copy->particle)).displacements;
      displacements.erase(std::find(displacements.begin(), displacements.end(), copy->requested));
    }
    body_->removeCopy(id);
  }
}

void Simulation::setPerturbations(const std::vector<Perturbation>& perturbations) {
  std::unique_ptr<Body> start = start_body_->clone();
  std::vector<AgentState> start_states = start_states_;
  for (AgentState& start_state : start_states) {
    start_state.displacements.clear();
  }
  const std::vector<int> before = idsOf(*body_);
  std::vector<int> added;
  try {
    for (const Perturbation& perturbation : perturbations) {
      AgentState& displaced = start_states.at(static_cast<std::size_t>(perturbation.agent));
      start->addCopy(displaced.particle, perturbation.displacement);
      displaced.displacements.push_back(perturbation.displacement);
      added.push_back(addPerturbation(perturbation));
    }
  } catch (const std::logic_error&) {
    removePerturbations(added);
    throw;
  }
  removePerturbations(before);
  for (int id : idsOf(*start_body_)) {
    start->removeCopy(id);
  }
  start_body_ = std::move(start);
  start_states_ = std::move(start_states);
  start_changed_ = true;
}

void Simulation::clearPerturbations(int agent) {
  std::vector<int> ids;
  for (const PerturbedCopy& copy : body_->copies()) {
    if (copy.particle == state(agent).particle) {
      ids.push_back(copy.id);
    }
  }
  removePerturbations(ids);
  state(agent).displacements.clear();
}

void Simulation::release(int agent) {
  AgentState& released = state(agent);
  if (released.particle < 0) {
    throw std::logic_error(agents_[agent].name + " holds nothing");
  }
  body_->release(released.particle);
  released.particle = -1;
  restartCorrection();
}

//! Further particles as they are, relative to a grip that is about to hold them.
std::vector<FurtherParticle> Simulation::heldAround(const Pose& grip, int particle,
                                                    const std::vector<int>& further) const {
  std::vector<FurtherParticle> held = placesAround(*body_, particle, further);
  const Quaternion back = grip.orientation.conjugate();
  for (FurtherParticle& each : held) {
    Pose now = body_->pose(each.particle);
    now.orientation = body_->particlesTurn() ? (back * now.orientation).normalized() : Quaternion::Identity();
    now.position = back * (now.position - grip.position);
    const double off = (now.position - each.place.position).norm();
    if (off > kGripReach) {
      throw std::logic_error("particle " + std::to_string(each.particle) + " is " + std::to_string(off) +
                             " m off its place in the grip; it can be gripped up to " + std::to_string(kGripReach) +
                             " m off");
    }
    each.place = now;
  }
  return held;
}

void Simulation::hold(int agent, int particle, Hold type, const std::vector<int>& further) {
  AgentState& holder = state(agent);
  if (holder.particle >= 0) {
    throw std::logic_error(agents_[agent].name + " already holds particle " + std::to_string(holder.particle) +
                           "; release it first");
  }
  const double distance = (body_->pose(particle).position - holder.pose.position).norm();
  if (distance > kGripReach) {
    throw std::logic_error("particle " + std::to_string(particle) + " is " + std::to_string(distance) +
                           " m away from " + agents_[agent].name + "; it can grip up to " + std::to_string(kGripReach) +
                           " m");
  }
  Pose grip = body_->pose(particle);
  if (!body_->particlesTurn()) {
    grip.orientation = holder.pose.orientation;
  }
  body_->hold(particle, heldAround(grip, particle, further), type, grip);
  holder.particle = particle;
  holder.pose = grip;
  for (const Vector3& displacement : holder.displacements) {
    body_->addCopy(particle, displacement);
  }
  restartCorrection();
}

void Simulation::setMaterial(const std::vector<MaterialParameter>& parameters) {
  body_->setMaterial(parameters);
  start_body_->setMaterial(parameters);
  start_changed_ = true;
}

int Simulation::agentOf(int particle) const {
  const auto found = std::find_if(states_.begin(), states_.end(),
                                  [particle](const AgentState& state) { return state.particle == particle; });
  return found == states_.end() ? -1 : static_cast<int>(found - states_.begin());
}

int Simulation::particleOf(int agent) const { return state(agent).particle; }

const Pose& Simulation::pose(int agent) const { return state(agent).pose; }

const Twist& Simulation::twist(int agent) const { return state(agent).twist; }

Wrench Simulation::wrench(int agent) const {
  const int particle = state(agent).particle;
  return particle >= 0 ? body_->gripWrench(particle) : Wrench();
}

ResponseStatus Simulation::response(double* to) {
  const std::size_t numbers = 9 * static_cast<std::size_t>(body_->pointCount());
  response_.resize(numbers * body_->gripCount());
  const ResponseStatus status = body_->response(response_.data());
  if (status == ResponseStatus::VALID) {
    spreadOverAgents(numbers, to);
  }
  return status;
}

bool Simulation::turningResponse(double* to) const {
  const std::size_t numbers = 9 * static_cast<std::size_t>(body_->pointCount());
  response_.resize(numbers * body_->gripCount());
  if (!body_->turningResponse(response_.data())) {
    return false;
  }
  spreadOverAgents(numbers, to);
  return true;
}

//! From the grips, in the body's order, to their agents; those who hold nothing get zeros.
void Simulation::spreadOverAgents(std::size_t numbers, double* to) const {
  std::fill_n(to, numbers * agents_.size(), 0.0);
  const double* from = response_.data();
  for (const HeldPoint& held : body_->holds()) {
    if (held.leads()) {
      std::copy_n(from, numbers, to + numbers * agentOf(held.particle));
      from += numbers;
    }
  }
}

void Simulation::wrenches(double* to) const {
  for (int copy = 0; copy < body_->copyCount(); ++copy) {
    for (const AgentState& agent : states_) {
      const Wrench wrench = agent.particle >= 0 ? body_->gripWrench(agent.particle, copy) : Wrench();
      Eigen::Map<Vector6>{to} = wrench.numbers();
      to += 6;
    }
  }
}

bool Simulation::wrenchResponse(double* to) const {
  response_.resize(36 * static_cast<std::size_t>(body_->gripCount()) * body_->gripCount());
  if (!body_->wrenchResponse(response_.data())) {
    return false;
  }
  std::fill_n(to, 36 * agents_.size() * agents_.size(), 0.0);
  const double* from = response_.data();
  for (const HeldPoint& of : body_->holds()) {
    for (int row = 0; of.leads() && row < 6; ++row) {
      const std::size_t to_row = 6 * agentOf(of.particle) + row;
      for (const HeldPoint& moved : body_->holds()) {
        if (moved.leads()) {
          std::copy_n(from, 6, to + 6 * (to_row * agents_.size() + agentOf(moved.particle)));
          from += 6;
        }
      }
    }
  }
  return true;
}

}  // namespace pbd
}  // namespace deformable_manipulation
