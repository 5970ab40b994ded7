#pragma once

#include "deformable_manipulation/control/load_barrier.h"

namespace deformable_manipulation {
namespace control {

//! Keeps the force or the torque at each agent's grip below a limit: h = limit - |force| [N] or |torque| [N m].
class GripBarrier final : public LoadBarrier {
 public:
  enum class Kind { FORCE, TORQUE };

  GripBarrier(Kind kind, const LoadParameters& parameters, const Team& team)
      : LoadBarrier(parameters, team), first_(kind == Kind::FORCE ? 0 : 3) {}

 protected:
  int count(const ObjectShape& shape) const override { return shape.wrenches != nullptr ? shape.agents : 0; }
  double load(const ObjectShape& shape, int agent) const override;
  void addGradient(const ObjectShape& shape, int agent, std::vector<Vector6>& gradients) const override;
  bool concerns(int item, int agent) const override { return item == agent || item == team().leader; }
  bool isDifferentiable(const ObjectShape& shape) const override { return shape.wrench_response != nullptr; }

 private:
  int first_;  // component of a wrench
};

}  // namespace control
}  // namespace deformable_manipulation
