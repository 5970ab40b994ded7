#pragma once

#include <utility>
#include <vector>

#include "deformable_manipulation/control/load_barrier.h"

namespace deformable_manipulation {
namespace control {

//! Keeps a rod from being bent too sharply anywhere: h = 1 / min_radius - curvature [1/m].
//!
//! The curvature of a joint is the angle between its two segments over the length of one.
class BendingBarrier final : public LoadBarrier {
 public:
  //! @param joint_lengths [N - 1] m, of the rod that bends in each joint
  BendingBarrier(const LoadParameters& parameters, std::vector<double> joint_lengths, const Team& team)
      : LoadBarrier(parameters, team), joint_lengths_(std::move(joint_lengths)) {}

 protected:
  int count(const ObjectShape& shape) const override { return shape.coordinates != nullptr ? shape.points - 2 : 0; }
  double load(const ObjectShape& shape, int joint) const override;
  void addGradient(const ObjectShape& shape, int joint, std::vector<Vector6>& gradients) const override;
  bool isDifferentiable(const ObjectShape& shape) const override { return shape.response != nullptr; }

 private:
  std::vector<double> joint_lengths_;
};

}  // namespace control
}  // namespace deformable_manipulation
