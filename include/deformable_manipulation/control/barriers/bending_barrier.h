#pragma once

#include "deformable_manipulation/control/load_barrier.h"

namespace deformable_manipulation {
namespace control {

//! Keeps a rod from being bent too sharply anywhere: h = 1 / min_radius - curvature [1/m].
//!
//! The curvature of a joint is the angle between its two segments over the length of one.
class BendingBarrier final : public LoadBarrier {
 public:
  //! @param segment_length [m]
  BendingBarrier(const LoadParameters& parameters, double segment_length, const Team& team)
      : LoadBarrier(parameters, team), segment_length_(segment_length) {}

 protected:
  int count(const ObjectShape& shape) const override { return shape.coordinates != nullptr ? shape.points - 2 : 0; }
  double load(const ObjectShape& shape, int joint) const override;
  void addGradient(const ObjectShape& shape, int joint, std::vector<Vector6>& gradients) const override;
  bool isDifferentiable(const ObjectShape& shape) const override { return shape.response != nullptr; }

 private:
  double segment_length_;
};

}  // namespace control
}  // namespace deformable_manipulation
