#include "deformable_manipulation/control/grip_barrier.h"

#include <cmath>

namespace deformable_manipulation {
namespace control {
namespace {

constexpr double NO_LIMIT = 1e6;  // [N] or [N m], as declared for scenarios

}  // namespace

GripBarrier::GripBarrier(Kind kind, const ParameterSection& section, const std::string& limit, const Team& team)
    : LoadBarrier(LoadParameters::read(section, section.number(limit)), team), first_(kind == Kind::FORCE ? 0 : 3) {
  const Vector3 limits = section.vector<3>(limit + "_per_axis");
  if (limits.minCoeff() >= NO_LIMIT) {
    return;
  }
  axis_limits_.assign(limits.data(), limits.data() + 3);
  const Eigen::MatrixXd orientations = section.matrix("orientations");
  const bool complete = orientations.rows() == team.agents && orientations.cols() == 4;
  section.check().require(complete, section.pathOf("orientations"), static_cast<double>(orientations.rows()),
                          "a quaternion x, y, z, w per agent");
  for (Eigen::Index agent = 0; complete && agent < orientations.rows(); ++agent) {
    at_start_.push_back(Quaternion(Eigen::Vector4d(orientations.row(agent))).normalized());
  }
}

int GripBarrier::count(const ObjectShape& shape) const {
  if (shape.wrenches == nullptr) {
    return 0;
  }
  return axis_limits_.empty() ? shape.agents : 4 * shape.agents;
}

bool GripBarrier::concerns(int item, int agent) const {
  return agentOf(item) == agent || agentOf(item) == team().leader;
}

//! The force or torque of an item's agent.
Vector3 GripBarrier::exerted(const ObjectShape& shape, int item) const {
  return shape.wrench(agentOf(item)).segment<3>(first_);
}

//! Of the grip, in the fixed frame.
Vector3 GripBarrier::axis(const ObjectShape& shape, int item) const {
  return shape.orientation(agentOf(item), at_start_[agentOf(item)]) * Vector3::Unit(axisOf(item));
}

double GripBarrier::load(const ObjectShape& shape, int item) const {
  const Vector3 whole = exerted(shape, item);
  return isNorm(item) ? whole.norm() : std::abs(whole.dot(axis(shape, item)));
}

//! The axes of a grip turn with it.
void GripBarrier::addGradient(const ObjectShape& shape, int item, std::vector<Vector6>& gradients) const {
  const Vector3 whole = exerted(shape, item);
  Vector6 direction = Vector6::Zero();
  if (isNorm(item)) {
    direction.segment<3>(first_) = whole.normalized();  // zero of zero
  } else {
    const Vector3 along = std::copysign(1.0, whole.dot(axis(shape, item))) * axis(shape, item);
    direction.segment<3>(first_) = along;
    gradients[agentOf(item)].tail<3>() += along.cross(whole);
  }
  shape.addWrenchGradient(agentOf(item), direction, gradients);
}

}  // namespace control
}  // namespace deformable_manipulation
