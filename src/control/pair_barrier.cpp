#include "deformable_manipulation/control/pair_barrier.h"

#include <algorithm>
#include <limits>

namespace deformable_manipulation {
namespace control {

PairParameters PairParameters::read(const ParameterSection& section, int agents) {
  PairParameters parameters{section.matrix("limits"), section.number("margin"),
                            PiecewiseLinearClassK::read(section, "alpha")};
  if (parameters.limits.rows() != agents || parameters.limits.cols() != agents) {
    section.check().require(false, section.pathOf("limits"), parameters.limits.rows(), "a row and a column per agent");
    parameters.limits.setZero(agents, agents);
  }
  return parameters;
}

PairBarrier::PairBarrier(Kind kind, const PairParameters& parameters, const Team& team)
    : sign_(kind == Kind::MAXIMUM ? -1.0 : 1.0), parameters_(parameters), team_(team) {}

double PairBarrier::value(const std::vector<Vector3>& positions, int agent, int other) const {
  return sign_ * ((positions[other] - positions[agent]).norm() - parameters_.limits(agent, other));
}

double PairBarrier::value(const PresentState& state, int agent) const {
  double least = std::numeric_limits<double>::infinity();
  for (int other = 0; other < team_.agents; ++other) {
    if (other != agent) {
      least = std::min(least, value(state.positions, agent, other));
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

void PairBarrier::addRows(const Features& /*features*/, const PredictedState& state, BarrierRows& rows) const {
  for (int column = 0; column < static_cast<int>(team_.commanded.size()); ++column) {
    for (int other = 0; other < team_.agents; ++other) {
      const int others_column = team_.columnOf(other);
      if (others_column < 0 || others_column > column) {  // once for two that are commanded
        addRow(state, column, other, rows);
      }
    }
  }
}

void PairBarrier::addRow(const PredictedState& state, int column, int other, BarrierRows& rows) const {
  const int agent = team_.commanded[column];
  const int others_column = team_.columnOf(other);
  const Vector3 g = gradient(state.positions, agent, other);
  const double alpha = parameters_.alpha(value(state.positions, agent, other) - parameters_.margin);
  if (others_column >= 0) {
    auto row = rows.limit(-alpha);
    row.segment<3>(3 * column) = g;
    row.segment<3>(3 * others_column) = -g;
    return;
  }
  const bool shares = team_.formulation.shares;
  const bool whole = other == team_.leader || !shares;
  const Vector3& velocity = state.velocities[shares ? team_.leader : other];
  rows.limit(g.dot(velocity) - (whole ? 1.0 : 0.5) * alpha).segment<3>(3 * column) = g;
}

}  // namespace control
}  // namespace deformable_manipulation
