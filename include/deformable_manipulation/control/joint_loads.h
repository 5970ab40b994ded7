#pragma once

#include <vector>

#include "deformable_manipulation/control/object_shape.h"
#include "deformable_manipulation/control/team.h"
#include "deformable_manipulation/parameters/parameter_section.h"

namespace deformable_manipulation {
namespace control {

//! What the joints of a rod bear: it follows from the wrenches at the grips and the weight of the segments in between.
//!
//! With the grips a and the segments i up to a joint at x, their centres c and directions d,
//!   force  = sum_a F_a - sum_i m_i w ,   moment = sum_a (T_a + (c_a - x) x F_a) - sum_i (m_i (c_i - x) + e_i d_i) x w
//!   ,
//! on the joint's first segment; F and T are what the rod exerts on the agents, w is the weight of a segment that
//! carries nothing, m_i w that of segment i with its point masses, and e_i w the moment of masses off its centre.
class JointLoads {
 public:
  //! @param section with the keys `weight` [N] of a segment of the usual length that carries nothing, `masses`, a row
  //! (m, e [m]) per segment, and `particles`, the segment that each agent holds
  JointLoads(const ParameterSection& section, const Team& team);

  //! [N] On the joint's first segment.
  Vector3 force(const ObjectShape& shape, int joint) const;

  //! [N m] On the joint's first segment, about the joint.
  Vector3 moment(const ObjectShape& shape, int joint) const;

  //! Adds the change of by . force to the gradients [A] by the held points and turns about them.
  void addForceGradient(const ObjectShape& shape, int joint, const Vector3& by, std::vector<Vector6>& gradients) const;

  //! Adds the change of by . moment, likewise.
  void addMomentGradient(const ObjectShape& shape, int joint, const Vector3& by, std::vector<Vector6>& gradients) const;

 private:
  Vector3 weight_;
  std::vector<double> masses_;  // [S] m
  std::vector<double> before_;  // [S + 1] sums of them: before_[i] without that of segment i
  std::vector<double> leans_;   // [S] m, e
  std::vector<int> particles_;  // [A]
};

}  // namespace control
}  // namespace deformable_manipulation
