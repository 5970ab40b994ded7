#pragma once

#include <vector>

#include "deformable_manipulation/control/joint_loads.h"
#include "deformable_manipulation/control/load_barrier.h"

namespace deformable_manipulation {
namespace control {

//! Keeps the tension anywhere in a rod below a limit: h = max_tension - tension [N].
//!
//! The tension is the part of a joint's force along the rod there.
class TensionBarrier final : public LoadBarrier {
 public:
  TensionBarrier(const LoadParameters& parameters, const JointLoads& loads, const Team& team)
      : LoadBarrier(parameters, team), loads_(loads) {}

 protected:
  int count(const ObjectShape& shape) const override {
    return shape.coordinates != nullptr && shape.wrenches != nullptr ? shape.points - 2 : 0;
  }
  double load(const ObjectShape& shape, int joint) const override;
  void addGradient(const ObjectShape& shape, int joint, std::vector<Vector6>& gradients) const override;
  bool isDifferentiable(const ObjectShape& shape) const override {
    return shape.response != nullptr && shape.wrench_response != nullptr;
  }

 private:
  JointLoads loads_;
};

}  // namespace control
}  // namespace deformable_manipulation
