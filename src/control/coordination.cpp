#include "deformable_manipulation/control/coordination.h"

#include <algorithm>

namespace deformable_manipulation {
namespace control {

namespace {

// Part of the largest velocity by which another assistant's command may differ from what was expected of it. A state
// that it did not get changes its command by less.
constexpr double AGREEMENT = 0.1;

//! Whether another assistant answered the state as this controller did, as far as it had to.
bool agrees(const AssistantIntent& told, const std::optional<double>& answered, double max_velocity,
            const TeamMember& member) {
  if (told.time != answered || !told.coordinated || told.follows != member.enabled) {
    return true;
  }
  return (told.command - member.command).cwiseAbs().maxCoeff() <= AGREEMENT * max_velocity;
}

//! Continues from where another assistant says it is. What is late tells only what lasts.
void take(const AssistantIntent& told, const std::optional<double>& answered, TeamMember& member) {
  if (!answered || told.time >= *answered) {
    member.command = told.command;
    member.acceleration = told.acceleration;
    member.departure = told.departure;
  }
  member.enabled = told.follows;
  member.reference = told.reference;
}

}  // namespace

void Coordination::reset() { others_.assign(others_.size(), Other{}); }

void Coordination::hear(int member, const AssistantIntent& intent) {
  Other& other = others_[member];
  if (!other.told || intent.time > other.told->time) {
    other.told = intent;
  }
}

void Coordination::listen(double time, const std::optional<double>& answered, double timeout, double max_velocity,
                          std::vector<TeamMember>& members) {
  hears_ = together_ = true;
  for (std::size_t i = 0; i < members.size(); ++i) {
    TeamMember& member = members[i];
    Other& other = others_[i];
    if (member.own) {
      continue;
    }
    if (!answered) {
      other.heard = time;  // the others begin, too
      other.hears = true;
    }
    if (other.told && other.told->time < time) {
      if (!agrees(*other.told, answered, max_velocity, member)) {
        other.disagreed = time;
      }
      take(*other.told, answered, member);
      other.hears = other.told->hears;
      other.heard = std::max(*other.heard, other.told->time);
      other.told.reset();
    }
    hears_ = hears_ && !isSilent(other, time, timeout) && !(other.disagreed && time - *other.disagreed <= timeout);
    together_ = together_ && hears_ && other.hears;
  }
}

bool Coordination::isSilent(const Other& other, double time, double timeout) const {
  return !trusting_ && time - *other.heard > timeout;
}

}  // namespace control
}  // namespace deformable_manipulation
