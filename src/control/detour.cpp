#include "deformable_manipulation/control/detour.h"

#include <algorithm>

namespace deformable_manipulation {
namespace control {
namespace {

constexpr double kRest = 0.005;    // [m/s] below which the leader is at rest
constexpr double kStays = 0.02;    // [m] within which it stays then
constexpr double kSlow = 0.01;     // [m/s] below which an assistant does not get on
constexpr double kFar = 0.05;      // [m] from its place
constexpr double kPatience = 1.0;  // [s] before a search begins
constexpr double kAhead = 2.0;     // steps that it aims ahead on the way
constexpr double kStride = 0.05;   // steps by which the aim moves
constexpr double kSlowest = 5.0;   // [s] without getting on before it gives up
constexpr double kForget = 30.0;   // [s] after which another search may find a way: obstacles may have moved
constexpr int kAttempts = 3;       // from where the assistant has got to

}  // namespace

void Detour::reset() {
  state_ = DetourState::NONE;
  rests_ = waits_ = false;
  attempts_ = 0;
  way_.clear();
}

void Detour::update(const ObservationView& observation, const Traveller& traveller,
                    const DetourSearch::Limits& limits) {
  aim_ = traveller.place;
  const bool stays = !rests_ || (traveller.leader - leader_).norm() < kStays;
  if (!(traveller.leader_velocity.norm() < kRest) || !stays || !traveller.follows) {
    reset();
    return;
  }
  if (!rests_) {
    rests_ = true;
    leader_ = traveller.leader;
  }
  const double time = observation.time;
  if (state_ == DetourState::NONE && isHeldOff(observation, traveller)) {
    state_ = DetourState::SEARCHING;
    search_.start(observation, traveller.agent, traveller.leader + traveller.place, limits);
  } else if (state_ == DetourState::SEARCHING) {
    search(time);
  } else if (state_ == DetourState::FOLLOWING) {
    follow(observation.position(traveller.agent), time);
  } else if (state_ == DetourState::NO_WAY && time - since_ > kForget) {
    reset();
  }
  if (state_ == DetourState::FOLLOWING) {
    aim_ = carrot_ - traveller.leader;
  }
}

//! Whether the assistant has been off its place for some time without getting on.
bool Detour::isHeldOff(const ObservationView& observation, const Traveller& traveller) {
  const Vector3 error = traveller.leader + traveller.place - observation.position(traveller.agent);
  const bool waits = search_.fits(observation) && error.norm() > kFar && traveller.command.norm() < kSlow;
  if (!waits || !waits_) {
    since_ = observation.time;
  }
  waits_ = waits;
  return waits && observation.time - since_ > kPatience;
}

void Detour::search(double time) {
  since_ = time;
  switch (search_.advance()) {
    case DetourSearch::Outcome::FOUND:
      way_ = search_.way();
      carrot_ = way_.front();
      state_ = DetourState::FOLLOWING;
      break;
    case DetourSearch::Outcome::NO_WAY:
      state_ = DetourState::NO_WAY;
      break;
    case DetourSearch::Outcome::SEARCHING:
      break;
  }
}

//! Moves the aim along the way so that it stays ahead of the assistant.
void Detour::follow(const Vector3& position, double time) {
  const double stride = kStride * search_.step();
  while (!way_.empty() && (carrot_ - position).norm() < kAhead * search_.step()) {
    const Vector3 left = way_.front() - carrot_;
    if (left.norm() <= stride) {
      carrot_ = way_.front();
      way_.erase(way_.begin());
    } else {
      carrot_ += stride * left.normalized();
    }
    since_ = time;
  }
  if (way_.empty()) {
    state_ = DetourState::NONE;
    waits_ = false;
  } else if (time - since_ > kSlowest) {  // the object is not where the search expects it
    way_.clear();
    waits_ = false;
    state_ = ++attempts_ < kAttempts ? DetourState::NONE : DetourState::NO_WAY;
    since_ = time;
  }
}

}  // namespace control
}  // namespace deformable_manipulation
