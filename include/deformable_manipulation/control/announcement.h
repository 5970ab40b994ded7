#pragma once

#include <string>

#include "deformable_manipulation/pbd/types.h"

namespace deformable_manipulation {
namespace control {

using pbd::Vector3;

//! Where the leader's held point will be, as somebody announces it: K times and positions in the fixed frame, straight
//! in between. This is a view: it does not own what it points to.
struct AnnouncementView {
  int count = 0;                      //!< K; 0: nothing is announced
  const double* times = nullptr;      //!< [K] s, by the clock of the observations, increasing
  const double* positions = nullptr;  //!< [K x 3] m

  double begin() const { return times[0]; }
  double end() const { return times[count - 1]; }

  //! [m] at a time from begin() to end(); before and after, the position at that end.
  Vector3 position(double time) const;
};

//! What makes an announcement unusable, as a clause, or an empty string: fewer than two times, a number that is not
//! finite, times that do not increase, or a speed that no leader has.
std::string findFault(const AnnouncementView& announcement);

}  // namespace control
}  // namespace deformable_manipulation
