#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "deformable_manipulation/pbd/rod.h"
#include "settling.h"

namespace deformable_manipulation {
namespace pbd {

//! The paper's rope, along the y axis.
inline RodParameters rope(int segments = 28) {
  RodParameters p;
  p.length = 2.25;
  p.radius = 0.0035;
  p.density = 1792.89;
  p.segments = segments;
  p.young_modulus = 30e6;
  p.torsion_modulus = 10e6;
  p.stretch = Stretch::ZERO;
  p.damping = 10.0;
  p.solver = RodSolver::DIRECT;
  p.gravity = {0.0, 0.0, -9.81};
  p.pose.orientation = Quaternion(Eigen::AngleAxisd(M_PI / 2.0, Vector3::UnitZ()));
  return p;
}

inline Pose gripAt(const RodParameters& p, const Vector3& position) { return {position, p.pose.orientation}; }

//! A rope held at both ends at the same height.
inline std::unique_ptr<Rod> hangingRope(const RodParameters& p, double span, Hold type) {
  auto rod = std::make_unique<Rod>(p);
  rod->hold(0, type, gripAt(p, Vector3::Zero()));
  rod->hold(p.segments - 1, type, gripAt(p, Vector3(0.0, span, 0.0)));
  rod->layOut();
  return rod;
}

inline std::vector<Vector3> positions(const Body& body, int copy = 0) {
  std::vector<Vector3> result(body.particleCount());
  body.positions(copy, result.front().data());
  return result;
}

inline std::vector<Vector3> velocities(const Body& body, int copy = 0) {
  std::vector<Vector3> result(body.particleCount());
  body.velocities(copy, result.front().data());
  return result;
}

//! Largest distance between the particles of two copies.
inline double difference(const Body& a, int copy_a, const Body& b, int copy_b) {
  const std::vector<Vector3> from = positions(a, copy_a);
  const std::vector<Vector3> to = positions(b, copy_b);
  double largest = 0.0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    largest = std::max(largest, (from[i] - to[i]).norm());
  }
  return largest;
}

}  // namespace pbd
}  // namespace deformable_manipulation
