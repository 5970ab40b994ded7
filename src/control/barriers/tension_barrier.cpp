#include "deformable_manipulation/control/barriers/tension_barrier.h"

namespace deformable_manipulation {
namespace control {

TensionBarrier::TensionBarrier(const LoadParameters& parameters, const Vector3& weight,
                               const std::vector<int>& particles, const Team& team)
    : LoadBarrier(parameters, team), weight_(weight), particles_(particles) {}

//! [N] Of a joint on its first segment: what the grips up to there bear, less the weight up to there.
Vector3 TensionBarrier::force(const ObjectShape& shape, int joint) const {
  Vector3 force = -(joint + 1) * weight_;
  for (int agent = 0; agent < shape.agents; ++agent) {
    if (particles_[agent] <= joint) {
      force += shape.wrench(agent).head<3>();
    }
  }
  return force;
}

double TensionBarrier::load(const ObjectShape& shape, int joint) const {
  return force(shape, joint).dot((shape.point(joint + 2) - shape.point(joint)).normalized());
}

void TensionBarrier::addGradient(const ObjectShape& shape, int joint, std::vector<Vector6>& gradients) const {
  const Vector3 along = shape.point(joint + 2) - shape.point(joint);
  const Vector3 tangent = along.normalized();
  const Vector3 pull = force(shape, joint);
  const Vector3 by_end = (pull - tangent.dot(pull) * tangent) / along.norm();
  shape.addPointGradient(joint, -by_end, gradients);
  shape.addPointGradient(joint + 2, by_end, gradients);
  Vector6 direction = Vector6::Zero();
  direction.head<3>() = tangent;
  for (int agent = 0; agent < shape.agents; ++agent) {
    if (particles_[agent] <= joint) {
      shape.addWrenchGradient(agent, direction, gradients);
    }
  }
}

namespace barriers {

std::unique_ptr<Barrier> tension(const ParameterSection& section, const Team& team) {
  const LoadParameters parameters = LoadParameters::read(section, section.number("max_tension"));
  const std::vector<int> particles = section.integers("particles");
  section.check().require(static_cast<int>(particles.size()) == team.agents, section.pathOf("particles"),
                          static_cast<double>(particles.size()), "a particle per agent");
  return std::make_unique<TensionBarrier>(parameters, section.vector<3>("weight"), particles, team);
}

}  // namespace barriers
}  // namespace control
}  // namespace deformable_manipulation
