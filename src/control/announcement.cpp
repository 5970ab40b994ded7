#include "deformable_manipulation/control/announcement.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace deformable_manipulation {
namespace control {
namespace {

constexpr double FASTEST = 5.0;  // [m/s] faster is no motion but a leap

Eigen::Map<const Vector3> positionOf(const AnnouncementView& announcement, int index) {
  return Eigen::Map<const Vector3>(announcement.positions + 3 * index);
}

}  // namespace

Vector3 AnnouncementView::position(double time) const {
  const int after = static_cast<int>(std::upper_bound(times, times + count, time) - times);
  if (after == 0 || after == count) {
    return positionOf(*this, after == 0 ? 0 : count - 1);
  }
  const double share = (time - times[after - 1]) / (times[after] - times[after - 1]);
  return (1.0 - share) * positionOf(*this, after - 1) + share * positionOf(*this, after);
}

std::string findFault(const AnnouncementView& announcement) {
  std::ostringstream fault;
  if (announcement.count < 2) {
    fault << "it has " << announcement.count << " positions, at least two are needed";
    return fault.str();
  }
  for (int k = 0; k < announcement.count && fault.str().empty(); ++k) {
    if (!std::isfinite(announcement.times[k]) || !positionOf(announcement, k).allFinite()) {
      fault << "position " << k << " or its time is not finite";
    } else if (k > 0) {
      const double passed = announcement.times[k] - announcement.times[k - 1];
      const double way = (positionOf(announcement, k) - positionOf(announcement, k - 1)).norm();
      if (passed <= 0.0) {
        fault << "the time of position " << k << " is not after the one before";
      } else if (way > FASTEST * passed) {
        fault << "position " << k << " is " << way << " m from the one before, " << passed << " s earlier: faster than "
              << FASTEST << " m/s";
      }
    }
  }
  return fault.str();
}

}  // namespace control
}  // namespace deformable_manipulation
