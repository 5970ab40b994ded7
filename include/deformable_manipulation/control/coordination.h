#pragma once

#include <optional>
#include <vector>

#include "deformable_manipulation/control/assistant_intent.h"
#include "deformable_manipulation/control/team_member.h"

namespace deformable_manipulation {
namespace control {

//! What other controllers tell about their assistants, and whether these go on as expected.
//!
//! While all hear one another, each controller solves the program of all assistants. It falls back to its shares while
//! nothing is heard of one for longer than the timeout, and for a timeout after one has done something else.
class Coordination {
 public:
  //! @param members of the program, [M]
  explicit Coordination(int members) : others_(members) {}

  //! Takes it that the others go on as expected, however long nothing is heard of them.
  void setTrusting(bool trusting) { trusting_ = trusting; }

  //! Forgets everything that was told.
  void reset();

  //! Keeps what is told about another's assistant until the next state, unless something newer was told.
  void hear(int member, const AssistantIntent& intent);

  //! Goes by what the others have told about the states before a new one.
  //! @param time [s] of the new state
  //! @param answered [s] time of the newest state that was answered, if any was
  //! @param timeout [s] after which one that is not heard counts as lost
  //! @param max_velocity [m/s] of the assistants
  //! @param members [M] those of others continue from where these say they are
  void listen(double time, const std::optional<double>& answered, double timeout, double max_velocity,
              std::vector<TeamMember>& members);

  //! The others are heard and go on as expected.
  bool hears() const { return hears_; }

  //! And they say the same of one another.
  bool together() const { return together_; }

 private:
  struct Other {
    std::optional<AssistantIntent> told = {};  // and not yet used
    bool hears = true;                         // it hears all others
    std::optional<double> heard = {};          // [s] time of the newest state that it told about
    std::optional<double> disagreed = {};      // [s] when it last did something else than expected
  };

  bool isSilent(const Other& other, double time, double timeout) const;

  std::vector<Other> others_;  // [M] those of the own assistants stay empty
  bool trusting_ = false;
  bool hears_ = true;
  bool together_ = true;
};

}  // namespace control
}  // namespace deformable_manipulation
