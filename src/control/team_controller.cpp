#include "deformable_manipulation/control/team_controller.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace deformable_manipulation {
namespace control {

namespace {

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

//! The filter's status, as far as it concerns one assistant.
Status statusOf(const Filtered& result, const Decision& decision) {
  if (result.status != Status::NOMINAL && result.status != Status::CONSTRAINED) {
    return result.status;
  }
  const double departure = (decision.command - decision.nominal).cwiseAbs().maxCoeff();
  return departure > VELOCITY_TOLERANCE ? Status::CONSTRAINED : Status::NOMINAL;
}

PairBarrier makePair(PairBarrier::Kind kind, const ControllerParameters& p, const PairParameters& pair) {
  return {kind, p.commanded, p.leader, pair.limits, pair.margin, pair.alpha, p.formulation.shares};
}

}  // namespace

TeamController::TeamController(const ControllerParameters& p)
    : parameters_(p),
      collision_(p.commanded, p.assistants, p.collision, p.max_velocity, p.formulation),
      overstretch_(makePair(PairBarrier::Kind::OVERSTRETCH, p, p.overstretch)),
      proximity_(makePair(PairBarrier::Kind::PROXIMITY, p, p.proximity)),
      velocities_(1e-4, p.timeout),
      differences_(static_cast<int>(p.overstretch.limits.rows()), p.leader),
      filter_(p.weights.replicate(p.commanded.size(), 1), p.priority, p.formulation.relaxation),
      positions_(p.overstretch.limits.rows()) {
  for (const int agent : p.commanded) {
    members_.push_back({agent, Vector3::Zero(), Vector3::Zero(), Vector3::Zero(), true});
  }
  setSmoothing();
  decisions_.resize(members_.size());
  for (Eigen::VectorXd* vector : {&nominal_, &lower_, &upper_}) {
    vector->setZero(3 * size());
  }
  reset();
}

void TeamController::setSmoothing() {
  kept_ = parameters_.smoothing > 0.0 ? std::exp(-parameters_.cycle_time / parameters_.smoothing) : 0.0;
  filter_.setAnticipation((1.0 - kept_) * ANTICIPATION_WEIGHT);
}

void TeamController::setParameters(const ControllerParameters& p) {
  const auto agents = static_cast<Eigen::Index>(positions_.size());
  if (p.commanded != parameters_.commanded || p.leader != parameters_.leader ||
      p.assistants != parameters_.assistants || p.overstretch.limits.rows() != agents ||
      p.proximity.limits.rows() != agents) {
    throw std::invalid_argument("parameters of other agents");
  }
  filter_.setWeights(p.weights.replicate(p.commanded.size(), 1));
  const Formulation formulation = parameters_.formulation;
  parameters_ = p;
  parameters_.formulation = formulation;
  setSmoothing();
  collision_ = CollisionBarrier(p.commanded, p.assistants, p.collision, p.max_velocity, formulation);
  overstretch_ = makePair(PairBarrier::Kind::OVERSTRETCH, parameters_, p.overstretch);
  proximity_ = makePair(PairBarrier::Kind::PROXIMITY, parameters_, p.proximity);
}

void TeamController::reset() {
  for (int i = 0; i < size(); ++i) {
    members_[i].reference = parameters_.references[i];
  }
  forget();
}

void TeamController::forget() {
  velocities_.reset();
  differences_.reset();
  stop();
  answered_ = false;
}

void TeamController::takeReference(int member, const ObservationView& observation) {
  Member& taking = members_[member];
  taking.reference = observation.position(taking.agent) - observation.position(parameters_.leader);
  taking.departure.setZero();  // it was from another nominal velocity
}

bool TeamController::isAnswered(double time) {
  if (answered_ && time < time_ - parameters_.timeout) {
    forget();
  }
  bool same = answered_ && time <= time_;
  for (int i = 0; i < size(); ++i) {
    same = same && decisions_[i].enabled == members_[i].enabled;
  }
  return same;
}

const std::vector<Decision>& TeamController::wait() {
  clearDecisions();
  stop();
  return decisions_;
}

void TeamController::stop() {
  for (Member& member : members_) {
    member.command.setZero();
    member.departure.setZero();
  }
}

void TeamController::clearDecisions() {
  for (int i = 0; i < size(); ++i) {
    decisions_[i] = Decision{};
    decisions_[i].enabled = members_[i].enabled;
  }
}

const std::vector<Decision>& TeamController::update(const ObservationView& observation) {
  if (!answered_ || observation.time > time_) {
    time_ = observation.time;
    answered_ = true;
  }
  const auto size = static_cast<Eigen::Index>(3 * observation.agents);
  velocities_.update(observation.time, Eigen::Map<const Eigen::VectorXd>(observation.positions, size));
  differences_.update(observation);
  predict(observation);
  clearDecisions();
  describe(observation);
  if (std::any_of(members_.begin(), members_.end(), [](const Member& member) { return member.enabled; })) {
    decide(observation);
  }
  conclude();
  return decisions_;
}

void TeamController::conclude() {
  for (int i = 0; i < size(); ++i) {
    Decision& decision = decisions_[i];
    if (!members_[i].enabled) {
      decision.status = Status::DISABLED;
      members_[i].departure.setZero();
    }
    members_[i].command = decision.command;
  }
}

//! The situation when the commands start to act: at the next state, or later if they are late.
void TeamController::predict(const ObservationView& observation) {
  const double* velocities = observation.velocities != nullptr ? observation.velocities : velocities_.velocity().data();
  situation_.leader = parameters_.leader;
  situation_.delay = parameters_.formulation.prediction ? parameters_.cycle_time + observation.lateness : 0.0;
  situation_.positions.resize(positions_.size());
  situation_.velocities.resize(positions_.size());
  for (int agent = 0; agent < observation.agents; ++agent) {
    positions_[agent] = observation.position(agent);
    situation_.velocities[agent] = Eigen::Map<const Vector3>(velocities + 3 * agent);
  }
  for (const Member& member : members_) {
    situation_.velocities[member.agent] = member.command;
  }
  for (int agent = 0; agent < observation.agents; ++agent) {
    situation_.positions[agent] = positions_[agent] + situation_.delay * situation_.velocities[agent];
  }
}

Vector3 TeamController::nominal(const Member& member) const {
  const Vector3 target = situation_.positions[parameters_.leader] + member.reference;
  const Vector3 back = parameters_.gain * (target - situation_.positions[member.agent]);
  return parameters_.formulation.leader_velocity ? Vector3(back + situation_.leaderVelocity()) : back;
}

//! What the decisions say about the present state, whatever the commands.
void TeamController::describe(const ObservationView& observation) {
  for (int i = 0; i < size(); ++i) {
    const Member& member = members_[i];
    Decision& decision = decisions_[i];
    decision.nominal = nominal(member);
    decision.position = positions_[member.agent];
    decision.target = positions_[parameters_.leader] + member.reference;
    decision.distance = observation.distances.minimum[0];
    decision.h_collision = collision_.value(decision.distance);
    decision.h_overstretch = overstretch_.lowest(positions_, member.agent);
    decision.h_proximity = proximity_.lowest(positions_, member.agent);
  }
}

void TeamController::decide(const ObservationView& observation) {
  const bool usable = findGradients(observation);
  if (parameters_.safety && features_.size() > 0 && !usable) {
    return;
  }
  describeGradients();
  setBounds();
  if (parameters_.safety) {
    passFiltered();
  } else {
    passUnfiltered();
  }
}

//! The near features with their gradients; false if those of a commanded assistant are not known.
bool TeamController::findGradients(const ObservationView& observation) {
  const bool nearest_only = !parameters_.formulation.every_feature;
  if (parameters_.exact_gradients && observation.sensitivities != nullptr) {
    takeResponseGradients(observation, parameters_.leader, nearest_only, features_);
    for (Decision& decision : decisions_) {
      decision.exact_jacobian = true;
    }
    return true;
  }
  if (nearest_only) {
    differences_.takeMinimum(observation.distances, features_);
  } else {
    differences_.takeGradients(observation.distances, features_);
  }
  bool known = true;
  for (int i = 0; i < size(); ++i) {
    decisions_[i].lacks_copies = !differences_.known(members_[i].agent);
    known = known && !decisions_[i].lacks_copies;
  }
  return known;
}

//! How the minimum distance changes with the motion of each commanded assistant and the leader.
void TeamController::describeGradients() {
  const bool any = features_.size() > 0;
  const double drift = any ? features_.gradient(0, parameters_.leader).dot(situation_.leaderVelocity()) : 0.0;
  for (int i = 0; i < size(); ++i) {
    decisions_[i].jacobian = any ? features_.gradient(0, members_[i].agent) : Vector3::Zero();
    decisions_[i].leader_drift = drift;
  }
}

//! Velocities that the limits of velocity and acceleration allow in the next cycle: zero for those who are disabled.
void TeamController::setBounds() {
  const double step = parameters_.formulation.acceleration_limit ? parameters_.max_acceleration * parameters_.cycle_time
                                                                 : std::numeric_limits<double>::infinity();
  for (int i = 0; i < size(); ++i) {
    auto lower = lower_.segment<3>(3 * i);
    auto upper = upper_.segment<3>(3 * i);
    if (members_[i].enabled) {
      lower = (members_[i].command.array() - step).cwiseMax(-parameters_.max_velocity);
      upper = (members_[i].command.array() + step).cwiseMin(parameters_.max_velocity);
    } else {
      lower.setZero();
      upper.setZero();
    }
  }
}

void TeamController::passUnfiltered() {
  for (int i = 0; i < size(); ++i) {
    const Vector3 command = decisions_[i].nominal.cwiseMax(lower_.segment<3>(3 * i)).cwiseMin(upper_.segment<3>(3 * i));
    if (command.allFinite()) {
      decisions_[i].status = Status::UNSAFE_FILTER_OFF;
      decisions_[i].command = command;
    } else {
      decisions_[i].status = Status::FAILED;
    }
  }
}

void TeamController::passFiltered() {
  rows_.clear(3 * size());
  collision_.addRows(features_, situation_, rows_);
  overstretch_.addRows(situation_, rows_);
  proximity_.addRows(situation_, rows_);
  for (int i = 0; i < size(); ++i) {
    const Vector3 nominal = decisions_[i].nominal + kept_ * members_[i].departure;
    nominal_.segment<3>(3 * i) = members_[i].enabled ? nominal : Vector3(Vector3::Zero());
  }
  const auto start = std::chrono::steady_clock::now();
  const Filtered& result = filter_.filter(nominal_, rows_, lower_, upper_);
  const double solve_time = secondsSince(start);
  for (int i = 0; i < size(); ++i) {
    Decision& decision = decisions_[i];
    decision.solve_time = solve_time;
    decision.command = result.velocity.segment<3>(3 * i);
    decision.status = statusOf(result, decision);
    keepDeparture(result.rows_act, decision, members_[i]);
    decision.rows = result.rows;
    decision.slack = result.slack;
  }
}

//! What the rows make of the nominal velocity lasts, what the bounds alone make of it does not.
void TeamController::keepDeparture(bool rows_act, const Decision& decision, Member& member) const {
  if (decision.status == Status::FAILED) {
    member.departure.setZero();
  } else if (rows_act) {
    member.departure = decision.command - decision.nominal;
  } else {
    member.departure *= kept_;
  }
}

}  // namespace control
}  // namespace deformable_manipulation
