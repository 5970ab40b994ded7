#include "deformable_manipulation/control/decision.h"

#include <utility>

namespace deformable_manipulation {
namespace control {

void Decision::clear(int barriers) {
  std::vector<double> kept_h = std::move(h);
  std::vector<double> kept_slack = std::move(slack);
  *this = Decision{};
  kept_h.assign(static_cast<std::size_t>(barriers), UNKNOWN);
  kept_slack.assign(static_cast<std::size_t>(barriers), 0.0);
  h = std::move(kept_h);
  slack = std::move(kept_slack);
}

}  // namespace control
}  // namespace deformable_manipulation
