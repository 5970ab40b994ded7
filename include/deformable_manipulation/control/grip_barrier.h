#pragma once

#include <vector>

#include "deformable_manipulation/control/load_barrier.h"

namespace deformable_manipulation {
namespace control {

//! Keeps the force or the torque at each agent's grip below a limit: h = limit - |force| [N] or |torque| [N m]; and, if
//! it has limits per axis, the components in the frame of the grip below these.
class GripBarrier final : public LoadBarrier {
 public:
  enum class Kind { FORCE, TORQUE };

  //! @param section with the keys `limit`, `limit`_per_axis and the orientations of the grips at the
  //! start
  GripBarrier(Kind kind, const ParameterSection& section, const std::string& limit, const Team& team);

 protected:
  int count(const ObjectShape& shape) const override;
  double limit(int item) const override { return isNorm(item) ? LoadBarrier::limit(item) : axis_limits_[axisOf(item)]; }
  double load(const ObjectShape& shape, int item) const override;
  void addGradient(const ObjectShape& shape, int item, std::vector<Vector6>& gradients) const override;
  bool concerns(int item, int agent) const override;
  bool isDifferentiable(const ObjectShape& shape) const override { return shape.wrench_response != nullptr; }

 private:
  // Items are the norms of all agents, then the axes of all agents.
  bool isNorm(int item) const { return item < team().agents; }
  int agentOf(int item) const { return isNorm(item) ? item : (item - team().agents) / 3; }
  int axisOf(int item) const { return (item - team().agents) % 3; }
  Vector3 exerted(const ObjectShape& shape, int item) const;
  Vector3 axis(const ObjectShape& shape, int item) const;

  int first_;                         // component of a wrench
  std::vector<double> axis_limits_;   // [3]; none: there are none
  std::vector<Quaternion> at_start_;  // [A] orientations of the grips
};

}  // namespace control
}  // namespace deformable_manipulation
