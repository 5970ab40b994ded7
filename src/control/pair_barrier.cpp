#include "deformable_manipulation/control/pair_barrier.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace deformable_manipulation {
namespace control {

PairBarrier::PairBarrier(Kind kind, int agent, int leader, std::vector<double> limits, double margin,
                         PiecewiseLinearClassK alpha, bool shares)
    : tier_(kind == Kind::OVERSTRETCH ? Tier::OVERSTRETCH : Tier::PROXIMITY),
      sign_(kind == Kind::OVERSTRETCH ? -1.0 : 1.0),
      agent_(agent),
      leader_(leader),
      limits_(std::move(limits)),
      margin_(margin),
      alpha_(alpha),
      shares_(shares) {}

double PairBarrier::value(const std::vector<Vector3>& positions, int other) const {
  return sign_ * ((positions[other] - positions[agent_]).norm() - limits_[other]);
}

double PairBarrier::lowest(const std::vector<Vector3>& positions) const {
  double least = std::numeric_limits<double>::infinity();
  for (int other = 0; other < agents(); ++other) {
    if (other != agent_) {
      least = std::min(least, value(positions, other));
    }
  }
  return least;
}

Vector3 PairBarrier::gradient(const std::vector<Vector3>& positions, int other) const {
  const Vector3 offset = positions[other] - positions[agent_];
  const double range = offset.norm();
  if (range > std::numeric_limits<double>::min()) {
    return -sign_ / range * offset;
  }
  return (other > agent_ ? -sign_ : sign_) * Vector3::UnitX();
}

void PairBarrier::addRows(const Situation& situation, ConstraintRows& rows) const {
  for (int other = 0; other < agents(); ++other) {
    if (other == agent_) {
      continue;
    }
    const Vector3 g = gradient(situation.positions, other);
    const double alpha = alpha_(value(situation.positions, other) - margin_);
    const bool whole = other == leader_ || !shares_;
    const Vector3& velocity = situation.velocities[shares_ ? leader_ : other];
    rows.add(tier_, g.data(), g.dot(velocity) - (whole ? 1.0 : 0.5) * alpha);
  }
}

}  // namespace control
}  // namespace deformable_manipulation
