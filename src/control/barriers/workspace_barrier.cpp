#include "deformable_manipulation/control/barriers/workspace_barrier.h"

#include <algorithm>
#include <limits>

namespace deformable_manipulation {
namespace control {
namespace {

constexpr double UNLIMITED = 1e6;  // m; the scenario's largest coordinate: a face of the box farther away is none

void addBox(const ParameterSection& workspace, WorkspaceParameters& parameters) {
  const Vector3 lower = workspace.vector<3>("lower");
  const Vector3 upper = workspace.vector<3>("upper");
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 inwards = Vector3::Unit(axis);
    if (lower[axis] > -UNLIMITED) {
      parameters.half_spaces.push_back({inwards, lower[axis]});
    }
    if (upper[axis] < UNLIMITED) {
      parameters.half_spaces.push_back({-inwards, -upper[axis]});
    }
  }
}

}  // namespace

WorkspaceParameters WorkspaceParameters::read(const ParameterSection& workspace) {
  WorkspaceParameters parameters{{}, {}, workspace.number("margin"), PiecewiseLinearClassK::read(workspace, "alpha")};
  addBox(workspace, parameters);
  for (const ParameterSection& plane : workspace.sections("planes")) {
    const Vector3 normal = plane.vector<3>("normal").normalized();
    parameters.half_spaces.push_back({normal, normal.dot(plane.vector<3>("point"))});
  }
  for (const ParameterSection& sphere : workspace.sections("spheres")) {
    parameters.balls.push_back({sphere.vector<3>("center"), sphere.number("radius")});
  }
  return parameters;
}

//! Calls take(h, gradient) for each half space and ball.
template <typename Take>
void WorkspaceBarrier::forEachLimit(const Vector3& position, Take take) const {
  for (const WorkspaceParameters::HalfSpace& half_space : parameters_.half_spaces) {
    take(half_space.normal.dot(position) - half_space.level, half_space.normal);
  }
  for (const WorkspaceParameters::Ball& ball : parameters_.balls) {
    const Vector3 outwards = position - ball.center;
    const double distance = outwards.norm();
    take(distance - ball.radius, distance > 0.0 ? Vector3(outwards / distance) : Vector3(Vector3::UnitX()));
  }
}

double WorkspaceBarrier::value(const PresentState& state, int agent) const {
  double least = std::numeric_limits<double>::infinity();
  forEachLimit(state.positions[agent], [&](double h, const Vector3&) { least = std::min(least, h); });
  return least;
}

void WorkspaceBarrier::addRows(const Features& /*features*/, const PredictedState& state, BarrierRows& rows) const {
  for (std::size_t column = 0; column < team_.commanded.size(); ++column) {
    forEachLimit(state.positions[team_.commanded[column]], [&](double h, const Vector3& gradient) {
      const double bound = -parameters_.alpha(h - parameters_.margin);
      if (bound > -team_.max_velocity * gradient.lpNorm<1>()) {
        rows.limit(bound).segment<3>(3 * column) = gradient;
      }
    });
  }
}

namespace barriers {

std::unique_ptr<Barrier> workspace(const ParameterSection& section, const Team& team) {
  return std::make_unique<WorkspaceBarrier>(WorkspaceParameters::read(section), team);
}

}  // namespace barriers

}  // namespace control
}  // namespace deformable_manipulation
