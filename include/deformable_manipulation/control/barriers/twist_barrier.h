#pragma once

#include <cmath>
#include <vector>

#include "deformable_manipulation/control/joint_loads.h"
#include "deformable_manipulation/control/load_barrier.h"

namespace deformable_manipulation {
namespace control {

//! Keeps a rod from being twisted too much anywhere: h = max_twist - |twist| [rad/m].
//!
//! The twist of a joint is the part of its moment along the rod there over the torsional stiffness. With the directions
//! d of its two segments that part is moment . (d_1 + d_2) / 2, for bending has its moment across both.
class TwistBarrier final : public LoadBarrier {
 public:
  //! @param stiffness [N m^2] torsional
  TwistBarrier(const LoadParameters& parameters, const JointLoads& loads, double stiffness, const Team& team)
      : LoadBarrier(parameters, team), loads_(loads), stiffness_(stiffness) {}

 protected:
  int count(const ObjectShape& shape) const override {
    return shape.coordinates != nullptr && shape.wrenches != nullptr ? shape.points - 2 : 0;
  }
  double load(const ObjectShape& shape, int joint) const override { return std::abs(twist(shape, joint)); }
  void addGradient(const ObjectShape& shape, int joint, std::vector<Vector6>& gradients) const override;
  bool isDifferentiable(const ObjectShape& shape) const override {
    return shape.response != nullptr && shape.wrench_response != nullptr;
  }

 private:
  double twist(const ObjectShape& shape, int joint) const;

  JointLoads loads_;
  double stiffness_;
};

}  // namespace control
}  // namespace deformable_manipulation
