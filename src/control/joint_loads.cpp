#include "deformable_manipulation/control/joint_loads.h"

namespace deformable_manipulation {
namespace control {
namespace {

Vector3 centre(const ObjectShape& shape, int segment) {
  return 0.5 * (shape.point(segment) + shape.point(segment + 1));
}

Vector3 span(const ObjectShape& shape, int segment) { return shape.point(segment + 1) - shape.point(segment); }

void addCentreGradient(const ObjectShape& shape, int segment, const Vector3& by, std::vector<Vector6>& gradients) {
  shape.addPointGradient(segment, 0.5 * by, gradients);
  shape.addPointGradient(segment + 1, 0.5 * by, gradients);
}

}  // namespace

JointLoads::JointLoads(const ParameterSection& section, const Team& team)
    : weight_(section.vector<3>("weight")), particles_(section.integers("particles")) {
  section.check().require(static_cast<int>(particles_.size()) == team.agents, section.pathOf("particles"),
                          static_cast<double>(particles_.size()), "a particle per agent");
  const Eigen::MatrixXd rows = section.matrix("masses");
  section.check().require(rows.cols() == 2, section.pathOf("masses"), static_cast<double>(rows.cols()),
                          "2 numbers per segment");
  before_.push_back(0.0);
  for (Eigen::Index i = 0; rows.cols() == 2 && i < rows.rows(); ++i) {
    masses_.push_back(rows(i, 0));
    before_.push_back(before_.back() + rows(i, 0));
    leans_.push_back(rows(i, 1));
  }
}

Vector3 JointLoads::force(const ObjectShape& shape, int joint) const {
  Vector3 force = -before_[joint + 1] * weight_;
  for (int agent = 0; agent < shape.agents; ++agent) {
    if (particles_[agent] <= joint) {
      force += shape.wrench(agent).head<3>();
    }
  }
  return force;
}

Vector3 JointLoads::moment(const ObjectShape& shape, int joint) const {
  const Vector3 here = shape.point(joint + 1);
  Vector3 moment = Vector3::Zero();
  for (int agent = 0; agent < shape.agents; ++agent) {
    if (particles_[agent] <= joint) {
      const Vector3 arm = centre(shape, particles_[agent]) - here;
      moment += shape.wrench(agent).tail<3>() + arm.cross(shape.wrench(agent).head<3>());
    }
  }
  for (int segment = 0; segment <= joint; ++segment) {
    moment -= (centre(shape, segment) - here).cross(masses_[segment] * weight_);
    if (leans_[segment] != 0.0) {
      moment -= leans_[segment] * span(shape, segment).normalized().cross(weight_);
    }
  }
  return moment;
}

void JointLoads::addForceGradient(const ObjectShape& shape, int joint, const Vector3& by,
                                  std::vector<Vector6>& gradients) const {
  Vector6 direction = Vector6::Zero();
  direction.head<3>() = by;
  for (int agent = 0; agent < shape.agents; ++agent) {
    if (particles_[agent] <= joint) {
      shape.addWrenchGradient(agent, direction, gradients);
    }
  }
}

//! by . (arm x F) changes with the arm by F x by, and with F by by x arm.
void JointLoads::addMomentGradient(const ObjectShape& shape, int joint, const Vector3& by,
                                   std::vector<Vector6>& gradients) const {
  const Vector3 here = shape.point(joint + 1);
  for (int agent = 0; agent < shape.agents; ++agent) {
    if (particles_[agent] > joint) {
      continue;
    }
    Vector6 direction;
    direction << by.cross(centre(shape, particles_[agent]) - here), by;
    shape.addWrenchGradient(agent, direction, gradients);
    addCentreGradient(shape, particles_[agent], shape.wrench(agent).head<3>().cross(by), gradients);
  }
  for (int segment = 0; segment <= joint; ++segment) {
    addCentreGradient(shape, segment, -masses_[segment] * weight_.cross(by), gradients);
    if (leans_[segment] != 0.0) {
      const Vector3 along = span(shape, segment);
      const Vector3 direction = along.normalized();
      const Vector3 change = -leans_[segment] * weight_.cross(by);
      const Vector3 by_end = (change - direction.dot(change) * direction) / along.norm();
      shape.addPointGradient(segment, -by_end, gradients);
      shape.addPointGradient(segment + 1, by_end, gradients);
    }
  }
  shape.addPointGradient(joint + 1, -force(shape, joint).cross(by), gradients);
}

}  // namespace control
}  // namespace deformable_manipulation
