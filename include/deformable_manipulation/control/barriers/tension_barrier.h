#pragma once

#include <vector>

#include "deformable_manipulation/control/load_barrier.h"

namespace deformable_manipulation {
namespace control {

//! Keeps the tension anywhere in a rod below a limit: h = max_tension - tension [N].
//!
//! The forces in the joints follow from the forces at the grips and the weight of the segments in between. The tension
//! is the part of a joint's force along the rod there.
class TensionBarrier final : public LoadBarrier {
 public:
  //! @param weight [N] of a segment
  //! @param particles [A] segment that each agent holds
  TensionBarrier(const LoadParameters& parameters, const Vector3& weight, const std::vector<int>& particles,
                 const Team& team);

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
  Vector3 force(const ObjectShape& shape, int joint) const;

  Vector3 weight_;
  std::vector<int> particles_;
};

}  // namespace control
}  // namespace deformable_manipulation
