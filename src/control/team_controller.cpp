#include "deformable_manipulation/control/team_controller.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace deformable_manipulation {
namespace control {

namespace {

Team commanding(Team team, const std::vector<int>& members) {
  const std::vector<int> all = std::move(team.commanded);
  team.commanded.clear();
  for (const int member : members) {
    team.commanded.push_back(all[member]);
  }
  return team;
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
      velocities_(1e-4, p.timeout),
      gradients_(p),
      coordination_(static_cast<int>(p.team.commanded.size())),
      together_(p, p.team) {
  present_.positions.resize(p.team.agents);
  members_.resize(p.team.commanded.size());
  for (int i = 0; i < size(); ++i) {
    members_[i].agent = p.team.commanded[i];
  }
  all_.resize(members_.size());
  std::iota(all_.begin(), all_.end(), 0);
  for (const int member : p.own) {
    members_.at(member).own = true;
  }
  if (p.own.size() < members_.size()) {
    alone_ = std::make_unique<TeamProgram>(p, commanding(p.team, p.own));
  }
  setSmoothing();
  decisions_.resize(members_.size());
  reset();
}

void TeamController::setSolver(const QpSolver& solver) {
  together_.setSolver(solver);
  if (alone_ != nullptr) {
    alone_->setSolver(solver);
  }
}

void TeamController::setForecast(std::shared_ptr<ObjectForecast> forecast) {
  forecast_ = std::move(forecast);
  horizon_ = std::make_unique<Horizon>(parameters_, forecast_);
}

void TeamController::setDetour(int member, DetourSearch search) { members_[member].detour.emplace(std::move(search)); }

void TeamController::setSmoothing() {
  kept_ = parameters_.smoothing > 0.0 ? std::exp(-parameters_.cycle_time / parameters_.smoothing) : 0.0;
  const double anticipation = (1.0 - kept_) * ANTICIPATION_WEIGHT;
  together_.setAnticipation(anticipation);
  if (alone_ != nullptr) {
    alone_->setAnticipation(anticipation);
  }
}

void TeamController::setParameters(const ControllerParameters& given) {
  const Team& team = parameters_.team;
  if (given.team.agents != team.agents || given.team.leader != team.leader || given.team.commanded != team.commanded ||
      given.team.assistants != team.assistants || given.own != parameters_.own ||
      given.barriers != parameters_.barriers) {
    throw std::invalid_argument("the parameters belong to other agents or barriers");
  }
  ControllerParameters p = given;
  p.team.formulation = team.formulation;
  together_.setParameters(p, p.team);
  if (alone_ != nullptr) {
    alone_->setParameters(p, commanding(p.team, p.own));
  }
  parameters_ = std::move(p);
  if (horizon_ != nullptr) {
    horizon_->setParameters(parameters_);
  }
  gradients_.setParameters(parameters_);
  setSmoothing();
}

std::vector<double> TeamController::margins(int member, const PresentState& state) const {
  std::vector<double> values;
  for (const auto& barrier : together_.barriers()) {
    values.push_back(barrier->value(state, members_[member].agent));
  }
  return values;
}

void TeamController::reset() {
  for (int i = 0; i < size(); ++i) {
    members_[i].reference = members_[i].aim = parameters_.references[i];
  }
  followers_.clear();
  for (const Vector3& place : parameters_.places) {
    followers_.push_back({place, true});
  }
  forget();
}

void TeamController::forget() {
  velocities_.reset();
  gradients_.reset();
  coordination_.reset();
  if (horizon_ != nullptr) {
    horizon_->reset();
  }
  for (TeamMember& member : members_) {
    member.stop();
    if (member.detour) {
      member.detour->reset();
    }
  }
  answered_.reset();
}

AssistantIntent TeamController::intent(int member) const {
  const TeamMember& m = members_[member];
  return {
      answered_.value_or(0.0), m.enabled && !waits_, coordination_.hears(), coordination_.together(), m.aim, m.command,
      m.acceleration,          m.departure};
}

void TeamController::hear(int member, const AssistantIntent& intent) {
  if (!members_[member].own) {
    coordination_.hear(member, intent);
  }
}

void TeamController::takeReference(int member, const ObservationView& observation) {
  TeamMember& taking = members_[member];
  taking.reference = observation.position(taking.agent) - observation.position(parameters_.team.leader);
  taking.aim = taking.reference;
  taking.departure.setZero();  // it was from another nominal velocity
  if (taking.detour) {
    taking.detour->reset();
  }
}

bool TeamController::isAnswered(double time) {
  if (answered_ && time < *answered_ - parameters_.timeout) {
    forget();
  }
  bool same = answered_ && time <= *answered_;
  for (const int i : parameters_.own) {
    same = same && decisions_[i].enabled == members_[i].enabled;
  }
  return same;
}

const std::vector<Decision>& TeamController::wait() {
  waits_ = true;
  clearDecisions();
  for (int i = 0; i < size(); ++i) {
    decisions_[i].command = members_[i].slowed(motionLimits());
    members_[i].setCommand(decisions_[i].command, parameters_.cycle_time);
    members_[i].departure.setZero();
  }
  return decisions_;
}

void TeamController::clearDecisions() {
  for (int i = 0; i < size(); ++i) {
    decisions_[i].clear(static_cast<int>(parameters_.barriers.size()));
    decisions_[i].enabled = members_[i].enabled;
    decisions_[i].coordinated = coordination_.together() && members_.size() == parameters_.team.assistants.size();
  }
}

const std::vector<Decision>& TeamController::update(const ObservationView& observation) {
  waits_ = false;
  coordination_.listen(observation.time, answered_, parameters_.timeout, parameters_.max_velocity, members_);
  answered_ = std::max(answered_.value_or(observation.time), observation.time);
  const Eigen::Index size = 3 * observation.agents;
  velocities_.update(observation.time, Eigen::Map<const Eigen::VectorXd>(observation.positions, size));
  gradients_.update(observation);
  predict(observation);
  findWays(observation);
  clearDecisions();
  describe(observation);
  for (std::size_t i = 0; i < members_.size(); ++i) {
    decisions_[i].command = members_[i].slowed(motionLimits());  // unless something else is decided
  }
  if (std::any_of(members_.begin(), members_.end(), [](const TeamMember& m) { return m.own && m.enabled; })) {
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
    members_[i].setCommand(decision.command, parameters_.cycle_time);
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
  for (const TeamMember& member : members_) {
    if (member.own || coordination_.together()) {
      predicted_.velocities[member.agent] = member.command;
    }
  }
  for (int agent = 0; agent < observation.agents; ++agent) {
    predicted_.positions[agent] = present_.positions[agent] + predicted_.delay * predicted_.velocities[agent];
  }
}

//! Where the members go: to their places, or on a way around what holds them off.
void TeamController::findWays(const ObservationView& observation) {
  const int leader = parameters_.team.leader;
  for (TeamMember& member : members_) {
    member.aim = member.reference;
    if (member.detour && parameters_.safety) {
      const DetourSearch::Limits limits = [this, agent = member.agent](const PresentState& state) {
        return lowestMargin(state, agent);
      };
      member.detour->update(observation,
                            {member.agent, member.reference, member.command, member.enabled,
                             observation.position(leader), predicted_.leaderVelocity()},
                            limits);
      member.aim = member.detour->aim();
    }
    followers_[member.agent].place = member.aim;
  }
}

//! The lowest h [m] of all barriers of an agent.
double TeamController::lowestMargin(const PresentState& state, int agent) const {
  double lowest = std::numeric_limits<double>::infinity();
  for (const auto& barrier : together_.barriers()) {
    lowest = std::min(lowest, barrier->value(state, agent));
  }
  return lowest;
}

Vector3 TeamController::nominal(const TeamMember& member) const {
  const Vector3 target = predicted_.positions[parameters_.team.leader] + member.aim;
  const Vector3 back = parameters_.gain * (target - predicted_.positions[member.agent]);
  return parameters_.team.formulation.leader_velocity ? Vector3(back + predicted_.leaderVelocity()) : back;
}

//! What the decisions say about the present state, whatever the commands.
void TeamController::describe(const ObservationView& observation) {
  present_.distance = observation.distances->minimum[0];
  for (int i = 0; i < size(); ++i) {
    const TeamMember& member = members_[i];
    Decision& decision = decisions_[i];
    decision.nominal = nominal(member);
    decision.detour = member.detour ? member.detour->state() : DetourState::NONE;
    decision.position = present_.positions[member.agent];
    decision.target = present_.positions[parameters_.team.leader] + member.reference;
    decision.distance = present_.distance;
    const auto& barriers = together_.barriers();
    for (std::size_t k = 0; k < barriers.size(); ++k) {
      decision.h[k] = barriers[k]->value(present_, member.agent);
    }
  }
}

void TeamController::decide(const ObservationView& observation) {
  gradients_.find(observation, moved_);
  const bool usable = gradientsAreKnown();
  if (parameters_.safety && gradients_.features().size() > 0 && !usable) {
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

//! Whether those of all commanded assistants are known; the decisions tell whose are not.
bool TeamController::gradientsAreKnown() {
  bool known = true;
  for (int i = 0; i < size(); ++i) {
    decisions_[i].exact_jacobian = gradients_.exact();
    decisions_[i].lacks_copies = !gradients_.known(members_[i].agent);
    known = known && !decisions_[i].lacks_copies;
  }
  return known;
}

//! How the minimum distance changes with the motion of each commanded assistant and the leader.
void TeamController::describeGradients() {
  const Features& features = gradients_.features();
  const bool any = features.size() > 0;
  const double drift = any ? features.gradient(0, parameters_.team.leader).dot(predicted_.leaderVelocity()) : 0.0;
  for (int i = 0; i < size(); ++i) {
    decisions_[i].jacobian = any ? features.gradient(0, members_[i].agent) : Vector3::Zero();
    decisions_[i].leader_drift = drift;
  }
}

MotionLimits TeamController::motionLimits() const {
  constexpr double NONE = std::numeric_limits<double>::infinity();
  const bool limited = parameters_.team.formulation.acceleration_limit;
  return {parameters_.max_velocity, limited ? parameters_.max_acceleration : NONE,
          limited ? parameters_.max_jerk : NONE, parameters_.cycle_time};
}

void TeamController::setBounds() {
  for (TeamMember& member : members_) {
    member.setBounds(motionLimits());
  }
}

//! Goals of the members: the nominal velocities, moved by what has to be done now for the sake of later.
void TeamController::lookAhead(const ObservationView& observation) {
  const bool looks = parameters_.safety && horizon_ != nullptr;
  if (looks) {
    for (const TeamMember& member : members_) {
      followers_[member.agent].follows = member.enabled;
    }
    if (forecast_->needsResponse()) {
      forecast_->setResponse(present_.positions, gradients_.response(observation));
    }
    horizon_->plan(observation, predicted_, followers_);
  }
  const double most = parameters_.max_velocity;
  for (int i = 0; i < size(); ++i) {
    const Vector3& nominal = decisions_[i].nominal;
    members_[i].goal =
        !looks ? nominal : Vector3(nominal.cwiseMax(-most).cwiseMin(most) + horizon_->departure(members_[i].agent));
  }
}

void TeamController::passUnfiltered() {
  for (int i = 0; i < size(); ++i) {
    const Vector3 command = decisions_[i].nominal.cwiseMax(members_[i].lower).cwiseMin(members_[i].upper);
    if (command.allFinite()) {
      decisions_[i].status = Status::UNSAFE_FILTER_OFF;
      decisions_[i].command = command;
    } else {
      decisions_[i].status = Status::FAILED;
    }
  }
}

void TeamController::passFiltered() {
  decideBy(together_, all_);
  if (!coordination_.together()) {
    decideBy(*alone_, parameters_.own);
  }
  for (int i = 0; i < size(); ++i) {
    keepDeparture(decisions_[i], members_[i]);
  }
}

//! Decides for some members by their program.
void TeamController::decideBy(TeamProgram& program, const std::vector<int>& members) {
  for (std::size_t column = 0; column < members.size(); ++column) {
    const int i = members[column];
    const TeamMember& member = members_[i];
    const Vector3 nominal = member.goal + kept_ * member.departure;
    program.want(static_cast<int>(column), member.enabled ? nominal : decisions_[i].command, member.lower,
                 member.upper);
  }
  const Filtered& result = program.solve(gradients_.features(), predicted_);
  for (std::size_t column = 0; column < members.size(); ++column) {
    Decision& decision = decisions_[members[column]];
    decision.solve_time += program.solveTime();
    if (result.status != Status::FAILED) {
      decision.command = result.velocity.segment<3>(3 * static_cast<Eigen::Index>(column));
    }
    decision.status = statusOf(result, decision);
    decision.rows = result.rows;
    std::copy_n(result.slack.begin(), decision.slack.size(), decision.slack.begin());
    members_[members[column]].rows_act = result.rows_act;
  }
}

//! What the rows make of the nominal velocity lasts, what the bounds alone make of it does not.
void TeamController::keepDeparture(const Decision& decision, TeamMember& member) const {
  if (decision.status == Status::FAILED) {
    member.departure.setZero();
  } else if (member.rows_act) {
    member.departure = decision.command - member.goal;
  } else {
    member.departure *= kept_;
  }
}

}  // namespace control
}  // namespace deformable_manipulation
