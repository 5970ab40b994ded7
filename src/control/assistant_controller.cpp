#include "deformable_manipulation/control/assistant_controller.h"

#include <chrono>
#include <stdexcept>

namespace deformable_manipulation {
namespace control {

namespace {

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

PairBarrier makePair(PairBarrier::Kind kind, const ControllerParameters& p, const PairParameters& pair) {
  return {kind, p.agent, p.leader, pair.limits, pair.margin, pair.alpha, p.formulation.shares};
}

}  // namespace

AssistantController::AssistantController(const ControllerParameters& p)
    : parameters_(p),
      collision_(p.agent, p.assistants, p.collision, p.max_velocity, p.formulation),
      overstretch_(makePair(PairBarrier::Kind::OVERSTRETCH, p, p.overstretch)),
      proximity_(makePair(PairBarrier::Kind::PROXIMITY, p, p.proximity)),
      velocities_(1e-4, p.timeout),
      differences_(static_cast<int>(p.overstretch.limits.size()), p.leader),
      filter_(p.weights, p.priority, p.formulation.relaxation),
      positions_(p.overstretch.limits.size()),
      lower_(3),
      upper_(3) {
  reset();
}

void AssistantController::setParameters(const ControllerParameters& p) {
  const auto agents = static_cast<std::size_t>(positions_.size());
  if (p.agent != parameters_.agent || p.leader != parameters_.leader || p.assistants != parameters_.assistants ||
      p.overstretch.limits.size() != agents || p.proximity.limits.size() != agents) {
    throw std::invalid_argument("parameters of other agents");
  }
  filter_.setWeights(p.weights);
  const Formulation formulation = parameters_.formulation;
  parameters_ = p;
  parameters_.formulation = formulation;
  collision_ = CollisionBarrier(p.agent, p.assistants, p.collision, p.max_velocity, formulation);
  overstretch_ = makePair(PairBarrier::Kind::OVERSTRETCH, parameters_, p.overstretch);
  proximity_ = makePair(PairBarrier::Kind::PROXIMITY, parameters_, p.proximity);
}

void AssistantController::reset() {
  reference_ = parameters_.reference;
  forget();
}

void AssistantController::forget() {
  velocities_.reset();
  differences_.reset();
  command_.setZero();
  answered_ = false;
}

void AssistantController::takeReference(const ObservationView& observation) {
  reference_ = observation.position(parameters_.agent) - observation.position(parameters_.leader);
}

bool AssistantController::isAnswered(double time) {
  if (answered_ && time < time_ - parameters_.timeout) {
    forget();
  }
  return answered_ && time <= time_ && decision_.enabled == enabled;
}

const Decision& AssistantController::wait() {
  command_.setZero();
  decision_ = Decision{};
  decision_.enabled = enabled;
  return decision_;
}

const Decision& AssistantController::update(const ObservationView& observation) {
  if (!answered_ || observation.time > time_) {
    time_ = observation.time;
    answered_ = true;
  }
  const auto size = static_cast<Eigen::Index>(3 * observation.agents);
  velocities_.update(observation.time, Eigen::Map<const Eigen::VectorXd>(observation.positions, size));
  differences_.update(observation);
  predict(observation);
  decision_ = Decision{};
  decision_.enabled = enabled;
  describe(observation);
  if (enabled) {
    decide(findGradients(observation));
  } else {
    decision_.status = Status::DISABLED;
  }
  command_ = decision_.command;
  return decision_;
}

//! The situation at the next state, when the command starts to act.
void AssistantController::predict(const ObservationView& observation) {
  situation_.leader = parameters_.leader;
  situation_.delay = parameters_.formulation.prediction ? parameters_.cycle_time : 0.0;
  situation_.positions.resize(positions_.size());
  situation_.velocities.resize(positions_.size());
  for (int agent = 0; agent < observation.agents; ++agent) {
    positions_[agent] = observation.position(agent);
    situation_.velocities[agent] =
        agent == parameters_.agent ? command_ : Vector3(velocities_.velocity().segment<3>(3 * agent));
    situation_.positions[agent] = positions_[agent] + situation_.delay * situation_.velocities[agent];
  }
}

Vector3 AssistantController::nominal() const {
  const Vector3 target = situation_.positions[parameters_.leader] + reference_;
  const Vector3 back = parameters_.gain * (target - situation_.positions[parameters_.agent]);
  return parameters_.formulation.leader_velocity ? Vector3(back + situation_.leaderVelocity()) : back;
}

//! What the decision says about the present state, whatever the command.
void AssistantController::describe(const ObservationView& observation) {
  decision_.nominal = nominal();
  decision_.position = positions_[parameters_.agent];
  decision_.target = positions_[parameters_.leader] + reference_;
  decision_.distance = observation.distances.minimum[0];
  decision_.h_collision = collision_.value(decision_.distance);
  decision_.h_overstretch = overstretch_.lowest(positions_);
  decision_.h_proximity = proximity_.lowest(positions_);
}

//! The near features with their gradients; false if those are not known.
bool AssistantController::findGradients(const ObservationView& observation) {
  const bool nearest_only = !parameters_.formulation.every_feature;
  decision_.exact_jacobian = parameters_.exact_gradients && observation.sensitivities != nullptr;
  if (decision_.exact_jacobian) {
    takeResponseGradients(observation, parameters_.leader, nearest_only, features_);
  } else if (nearest_only) {
    differences_.takeMinimum(observation.distances, features_);
  } else {
    differences_.takeGradients(observation.distances, features_);
  }
  return decision_.exact_jacobian || differences_.known(parameters_.agent);
}

void AssistantController::decide(bool usable) {
  if (parameters_.safety && features_.size() > 0 && !usable) {
    decision_.lacks_copies = true;
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

//! How the minimum distance changes with this agent's and the leader's motion.
void AssistantController::describeGradients() {
  const bool any = features_.size() > 0;
  decision_.jacobian = any ? features_.gradient(0, parameters_.agent) : Vector3::Zero();
  decision_.leader_drift = any ? features_.gradient(0, parameters_.leader).dot(situation_.leaderVelocity()) : 0.0;
}

//! Velocities that the limits of velocity and acceleration allow in the next cycle.
void AssistantController::setBounds() {
  lower_.setConstant(-parameters_.max_velocity);
  upper_.setConstant(parameters_.max_velocity);
  if (parameters_.formulation.acceleration_limit) {
    const double step = parameters_.max_acceleration * parameters_.cycle_time;
    lower_ = lower_.array().max(command_.array() - step);
    upper_ = upper_.array().min(command_.array() + step);
  }
}

void AssistantController::passUnfiltered() {
  const Vector3 command = decision_.nominal.cwiseMax(lower_).cwiseMin(upper_);
  if (command.allFinite()) {
    decision_.status = Status::UNSAFE_FILTER_OFF;
    decision_.command = command;
  } else {
    decision_.status = Status::FAILED;
  }
}

void AssistantController::passFiltered() {
  rows_.clear(3);
  collision_.addRows(features_, situation_, rows_);
  overstretch_.addRows(situation_, rows_);
  proximity_.addRows(situation_, rows_);
  nominal_ = decision_.nominal;
  const auto start = std::chrono::steady_clock::now();
  const Filtered& result = filter_.filter(nominal_, rows_, lower_, upper_);
  decision_.solve_time = secondsSince(start);
  decision_.status = result.status;
  decision_.command = result.velocity;
  decision_.rows = result.rows;
  decision_.slack = result.slack;
}

}  // namespace control
}  // namespace deformable_manipulation
