#include "deformable_manipulation/control/pair_barrier.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace deformable_manipulation {
namespace control {

PairBarrier::PairBarrier(Kind kind, std::vector<int> commanded, int leader, Eigen::MatrixXd limits, double margin,
                         PiecewiseLinearClassK alpha, bool shares)
    : tier_(kind == Kind::OVERSTRETCH ? Tier::OVERSTRETCH : Tier::PROXIMITY),
      sign_(kind == Kind::OVERSTRETCH ? -1.0 : 1.0),
      commanded_(std::move(commanded)),
      leader_(leader),
      limits_(std::move(limits)),
      margin_(margin),
      alpha_(alpha),
      shares_(shares) {}

double PairBarrier::value(const std::vector<Vector3>& positions, int agent, int other) const {
  return sign_ * ((positions[other] - positions[agent]).norm() - limits_(agent, other));
}

double PairBarrier::lowest(const std::vector<Vector3>& positions, int agent) const {
  double least = std::numeric_limits<double>::infinity();
  for (int other = 0; other < agents(); ++other) {
    if (other != agent) {
      least = std::min(least, value(positions, agent, other));
    }
  }
  return least;
}

Vector3 PairBarrier::gradient(const std::vector<Vector3>& positions, int agent, int other) const {
  const Vector3 offset = positions[other] - positions[agent];
  const double range = offset.norm();
  if (range > std::numeric_limits<double>::min()) {
    return -sign_ / range * offset;
  }
  return (other > agent ? -sign_ : sign_) * Vector3::UnitX();
}

void PairBarrier::addRows(const Situation& situation, ConstraintRows& rows) const {
  for (int column = 0; column < static_cast<int>(commanded_.size()); ++column) {
    for (int other = 0; other < agents(); ++other) {
      const int others_column = columnOf(other);
      if (others_column < 0 || others_column > column) {  // once for two that are commanded
        addRow(situation, column, other, rows);
      }
    }
  }
}

//! Where the velocity of an agent is among the variables, in threes; -1: it is none.
int PairBarrier::columnOf(int agent) const {
  const auto found = std::find(commanded_.begin(), commanded_.end(), agent);
  return found == commanded_.end() ? -1 : static_cast<int>(found - commanded_.begin());
}

void PairBarrier::addRow(const Situation& situation, int column, int other, ConstraintRows& rows) const {
  const int agent = commanded_[column];
  const int others_column = columnOf(other);
  const Vector3 g = gradient(situation.positions, agent, other);
  const double alpha = alpha_(value(situation.positions, agent, other) - margin_);
  if (others_column >= 0) {
    auto row = rows.add(tier_, -alpha);
    row.segment<3>(3 * column) = g;
    row.segment<3>(3 * others_column) = -g;
    return;
  }
  const bool whole = other == leader_ || !shares_;
  const Vector3& velocity = situation.velocities[shares_ ? leader_ : other];
  rows.add(tier_, g.dot(velocity) - (whole ? 1.0 : 0.5) * alpha).segment<3>(3 * column) = g;
}

}  // namespace control
}  // namespace deformable_manipulation
