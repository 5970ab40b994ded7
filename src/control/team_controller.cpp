#include "deformable_manipulation/control/team_controller.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

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

}  // namespace

TeamController::TeamController(const ControllerParameters& p)
    : parameters_(p),
      barriers_(makeBarriers(p.barriers, p.values, p.team)),
      velocities_(1e-4, p.timeout),
      differences_(p.team.agents, p.team.leader),
      disturbances_(p.disturbance_filter),
      filter_(p.weights.replicate(p.team.commanded.size(), 1), p.priority, p.team.formulation.relaxation) {
  present_.positions.resize(p.team.agents);
  for (const int agent : p.team.commanded) {
    members_.push_back(
        {agent, Vector3::Zero(), Vector3::Zero(), Vector3::Zero(), Vector3::Zero(), Vector3::Zero(), true});
  }
  setSmoothing();
  decisions_.resize(members_.size());
  for (Eigen::VectorXd* vector : {&nominal_, &lower_, &upper_}) {
    vector->setZero(3 * size());
  }
  reset();
}

void TeamController::setForecast(std::shared_ptr<ObjectForecast> forecast) {
  forecast_ = std::move(forecast);
  horizon_ = std::make_unique<Horizon>(parameters_, forecast_);
}

void TeamController::setSmoothing() {
  kept_ = parameters_.smoothing > 0.0 ? std::exp(-parameters_.cycle_time / parameters_.smoothing) : 0.0;
  filter_.setAnticipation((1.0 - kept_) * ANTICIPATION_WEIGHT);
}

void TeamController::setParameters(const ControllerParameters& given) {
  const Team& team = parameters_.team;
  if (given.team.agents != team.agents || given.team.leader != team.leader || given.team.commanded != team.commanded ||
      given.team.assistants != team.assistants || given.barriers != parameters_.barriers) {
    throw std::invalid_argument("the parameters belong to other agents or barriers");
  }
  ControllerParameters p = given;
  p.team.formulation = team.formulation;
  std::vector<std::unique_ptr<Barrier>> barriers = makeBarriers(p.barriers, p.values, p.team);
  filter_.setWeights(p.weights.replicate(p.team.commanded.size(), 1));
  parameters_ = std::move(p);
  barriers_ = std::move(barriers);
  if (horizon_ != nullptr) {
    horizon_->setParameters(parameters_);
  }
  disturbances_.setTimeConstant(parameters_.disturbance_filter);
  setSmoothing();
}

std::vector<double> TeamController::margins(int member, const PresentState& state) const {
  std::vector<double> values;
  for (const auto& barrier : barriers_) {
    values.push_back(barrier->value(state, members_[member].agent));
  }
  return values;
}

void TeamController::reset() {
  for (int i = 0; i < size(); ++i) {
    members_[i].reference = parameters_.references[i];
  }
  followers_.clear();
  for (const Vector3& place : parameters_.places) {
    followers_.push_back({place, true});
  }
  forget();
}

void TeamController::forget() {
  velocities_.reset();
  differences_.reset();
  disturbances_.reset();
  if (horizon_ != nullptr) {
    horizon_->reset();
  }
  stop();
  answered_ = false;
}

void TeamController::takeReference(int member, const ObservationView& observation) {
  Member& taking = members_[member];
  taking.reference = observation.position(taking.agent) - observation.position(parameters_.team.leader);
  followers_[taking.agent].place = taking.reference;
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
  for (int i = 0; i < size(); ++i) {
    decisions_[i].command = slowed(members_[i]);
    setCommand(decisions_[i].command, members_[i]);
    members_[i].departure.setZero();
  }
  return decisions_;
}

void TeamController::stop() {
  for (Member& member : members_) {
    member.command.setZero();
    member.acceleration.setZero();
    member.departure.setZero();
  }
}

void TeamController::setCommand(const Vector3& command, Member& member) const {
  member.acceleration = (command - member.command) / parameters_.cycle_time;
  member.command = command;
}

void TeamController::clearDecisions() {
  for (int i = 0; i < size(); ++i) {
    decisions_[i].clear(static_cast<int>(barriers_.size()));
    decisions_[i].enabled = members_[i].enabled;
  }
}

const std::vector<Decision>& TeamController::update(const ObservationView& observation) {
  if (!answered_ || observation.time > time_) {
    time_ = observation.time;
    answered_ = true;
  }
  const Eigen::Index size = 3 * observation.agents;
  velocities_.update(observation.time, Eigen::Map<const Eigen::VectorXd>(observation.positions, size));
  differences_.update(observation);
  predict(observation);
  clearDecisions();
  describe(observation);
  for (std::size_t i = 0; i < members_.size(); ++i) {
    decisions_[i].command = slowed(members_[i]);  // unless something else is decided
  }
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
    setCommand(decision.command, members_[i]);
  }
}

//! The state when the commands start to act: at the next state, or later if they are late.
void TeamController::predict(const ObservationView& observation) {
  const double* velocities = observation.velocities != nullptr ? observation.velocities : velocities_.velocity().data();
  predicted_.leader = parameters_.team.leader;
  predicted_.delay = parameters_.team.formulation.prediction ? parameters_.cycle_time + observation.lateness : 0.0;
  predicted_.positions.resize(present_.positions.size());
  predicted_.velocities.resize(present_.positions.size());
  moved_.resize(present_.positions.size());
  for (int agent = 0; agent < observation.agents; ++agent) {
    present_.positions[agent] = observation.position(agent);
    moved_[agent] = Eigen::Map<const Vector3>(velocities + 3 * agent);
    predicted_.velocities[agent] = moved_[agent];
  }
  for (const Member& member : members_) {
    predicted_.velocities[member.agent] = member.command;
  }
  for (int agent = 0; agent < observation.agents; ++agent) {
    predicted_.positions[agent] = present_.positions[agent] + predicted_.delay * predicted_.velocities[agent];
  }
}

Vector3 TeamController::nominal(const Member& member) const {
  const Vector3 target = predicted_.positions[parameters_.team.leader] + member.reference;
  const Vector3 back = parameters_.gain * (target - predicted_.positions[member.agent]);
  return parameters_.team.formulation.leader_velocity ? Vector3(back + predicted_.leaderVelocity()) : back;
}

//! What the decisions say about the present state, whatever the commands.
void TeamController::describe(const ObservationView& observation) {
  present_.distance = observation.distances->minimum[0];
  for (int i = 0; i < size(); ++i) {
    const Member& member = members_[i];
    Decision& decision = decisions_[i];
    decision.nominal = nominal(member);
    decision.position = present_.positions[member.agent];
    decision.target = present_.positions[parameters_.team.leader] + member.reference;
    decision.distance = present_.distance;
    for (std::size_t k = 0; k < barriers_.size(); ++k) {
      decision.h[k] = barriers_[k]->value(present_, member.agent);
    }
  }
}

void TeamController::decide(const ObservationView& observation) {
  const bool usable = findGradients(observation);
  disturbances_.update(observation.time, moved_, parameters_.team.formulation.obstacle_velocity, features_);
  if (parameters_.safety && features_.size() > 0 && !usable) {
    return;
  }
  describeGradients();
  setBounds();
  lookAhead(observation);
  if (parameters_.safety) {
    passFiltered();
  } else {
    passUnfiltered();
  }
}

//! The near features with their gradients; false if those of a commanded assistant are not known.
bool TeamController::findGradients(const ObservationView& observation) {
  const bool nearest_only = !parameters_.team.formulation.every_feature;
  if (parameters_.exact_gradients && observation.sensitivities != nullptr) {
    ChosenFeatures chosen{*observation.distances};
    if (nearest_only) {
      chosen.most = 1;
    }
    takeResponseGradients(chosen, {observation.sensitivities, observation.agents, observation.points},
                          parameters_.team.leader, features_);
    for (Decision& decision : decisions_) {
      decision.exact_jacobian = true;
    }
    return true;
  }
  if (nearest_only) {
    differences_.takeMinimum(*observation.distances, features_);
  } else {
    differences_.takeGradients(*observation.distances, features_);
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
  const double drift = any ? features_.gradient(0, parameters_.team.leader).dot(predicted_.leaderVelocity()) : 0.0;
  for (int i = 0; i < size(); ++i) {
    decisions_[i].jacobian = any ? features_.gradient(0, members_[i].agent) : Vector3::Zero();
    decisions_[i].leader_drift = drift;
  }
}

MotionLimits TeamController::motionLimits() const {
  constexpr double NONE = std::numeric_limits<double>::infinity();
  const bool limited = parameters_.team.formulation.acceleration_limit;
  return {parameters_.max_velocity, limited ? parameters_.max_acceleration : NONE,
          limited ? parameters_.max_jerk : NONE, parameters_.cycle_time};
}

//! The next command of an assistant on its way to rest.
Vector3 TeamController::slowed(const Member& member) const {
  const MotionLimits limits = motionLimits();
  Vector3 command;
  for (int axis = 0; axis < 3; ++axis) {
    command[axis] = limits.slowed(member.command[axis], member.acceleration[axis]);
  }
  return command;
}

//! Velocities that the limits allow in the next cycle: for those who are disabled, the one on their way to rest.
void TeamController::setBounds() {
  const MotionLimits limits = motionLimits();
  for (int i = 0; i < size(); ++i) {
    const Member& member = members_[i];
    const Vector3& slower = decisions_[i].command;  // so far
    for (int axis = 0; axis < 3; ++axis) {
      const VelocityRange range = member.enabled ? limits.next(member.command[axis], member.acceleration[axis])
                                                 : VelocityRange{slower[axis], slower[axis]};
      lower_[3 * i + axis] = range.lower;
      upper_[3 * i + axis] = range.upper;
    }
  }
}

//! Goals of the members: the nominal velocities, moved by what has to be done now for the sake of later.
void TeamController::lookAhead(const ObservationView& observation) {
  const bool looks = parameters_.safety && horizon_ != nullptr;
  if (looks) {
    for (const Member& member : members_) {
      followers_[member.agent].follows = member.enabled;
    }
    tellResponse(observation);
    horizon_->plan(observation, predicted_, followers_);
  }
  const double most = parameters_.max_velocity;
  for (int i = 0; i < size(); ++i) {
    const Vector3& nominal = decisions_[i].nominal;
    members_[i].goal =
        !looks ? nominal : Vector3(nominal.cwiseMax(-most).cwiseMin(most) + horizon_->departure(members_[i].agent));
  }
}

//! Tells the forecast how the object follows its held points, if it has to be told.
void TeamController::tellResponse(const ObservationView& observation) {
  if (!forecast_->needsResponse()) {
    return;
  }
  if (decisions_.front().exact_jacobian) {
    response_.assign(observation.sensitivities,
                     observation.sensitivities + 9 * observation.agents * observation.points);
  } else {
    differences_.takeResponse(response_);
  }
  forecast_->setResponse(present_.positions, response_);
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
  const int limits = static_cast<int>(barriers_.size());
  for (int k = 0; k < limits; ++k) {
    BarrierRows rows(rows_, k, limits);
    barriers_[k]->addRows(features_, predicted_, rows);
  }
  for (int i = 0; i < size(); ++i) {
    const Vector3 nominal = members_[i].goal + kept_ * members_[i].departure;
    nominal_.segment<3>(3 * i) = members_[i].enabled ? nominal : decisions_[i].command;
  }
  const auto start = std::chrono::steady_clock::now();
  const Filtered& result = filter_.filter(nominal_, rows_, lower_, upper_);
  const double solve_time = secondsSince(start);
  for (int i = 0; i < size(); ++i) {
    Decision& decision = decisions_[i];
    decision.solve_time = solve_time;
    if (result.status != Status::FAILED) {
      decision.command = result.velocity.segment<3>(3 * i);
    }
    decision.status = statusOf(result, decision);
    keepDeparture(result.rows_act, decision, members_[i]);
    decision.rows = result.rows;
    std::copy_n(result.slack.begin(), barriers_.size(), decision.slack.begin());
  }
}

//! What the rows make of the nominal velocity lasts, what the bounds alone make of it does not.
void TeamController::keepDeparture(bool rows_act, const Decision& decision, Member& member) const {
  if (decision.status == Status::FAILED) {
    member.departure.setZero();
  } else if (rows_act) {
    member.departure = decision.command - member.goal;
  } else {
    member.departure *= kept_;
  }
}

}  // namespace control
}  // namespace deformable_manipulation
