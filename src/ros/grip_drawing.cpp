#include "grip_drawing.h"

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "marker_parts.h"

namespace deformable_manipulation {
namespace {

using Eigen::Vector3d;
using visualization_msgs::Marker;

constexpr double kBarWidth = 0.03;  // m

//! [m] A rod's segment is at its centre, a fabric's vertex is a point.
Vector3d particleAt(const ObjectState& state, int particle) {
  const Eigen::Map<const Eigen::Matrix3Xd> points(state.points.data(), 3, state.point_count);
  const bool is_rod = state.object_type == ObjectState::ROD;
  return is_rod ? Vector3d(0.5 * (points.col(particle) + points.col(particle + 1))) : Vector3d(points.col(particle));
}

std::vector<Vector3d> heldBy(const ObjectState& state, int agent) {
  std::vector<Vector3d> held;
  for (std::size_t i = 0; i < state.further_particles.size(); ++i) {
    if (state.further_agents[i] == agent) {
      held.push_back(particleAt(state, state.further_particles[i]));
    }
  }
  if (!held.empty()) {
    held.push_back(particleAt(state, state.agent_particles[agent]));
  }
  return held;
}

}  // namespace

//! Joins the nearest particle that is not joined yet, again and again (Prim's minimum spanning tree).
Marker drawGrip(const ObjectState& state, int agent, bool is_leader) {
  Marker bar = emptyMarker(state, "grips", agent, Marker::LINE_LIST, agentColor(is_leader, 1.0));
  bar.scale.x = kBarWidth;
  std::vector<Vector3d> apart = heldBy(state, agent);
  std::vector<Vector3d> joined;
  while (!apart.empty()) {
    std::size_t next = apart.size() - 1;
    Vector3d from = apart[next];
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < apart.size(); ++i) {
      for (const Vector3d& end : joined) {
        if ((apart[i] - end).norm() < nearest) {
          nearest = (apart[i] - end).norm();
          next = i;
          from = end;
        }
      }
    }
    if (!joined.empty()) {
      bar.points.push_back(toPoint(from.data()));
      bar.points.push_back(toPoint(apart[next].data()));
    }
    joined.push_back(apart[next]);
    apart.erase(apart.begin() + static_cast<std::ptrdiff_t>(next));
  }
  return bar;
}

}  // namespace deformable_manipulation
