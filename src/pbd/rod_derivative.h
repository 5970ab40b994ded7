#pragma once

#include <vector>

#include "deformable_manipulation/pbd/types.h"
#include "rod_equilibrium_kernel.h"

namespace deformable_manipulation {
namespace pbd {

//! How one copy of a rod in equilibrium changes to first order when a hold moves or turns, from the matrices of the
//! last Newton step (docs/mathematics.md, "Equilibrium and its derivative"). It is read only as long as they live.
class RodDerivative {
 public:
  RodDerivative(const RodEquilibriumInput& input, const RodEquilibriumLanes& lanes, int lane);

  //! What the rod exerts on the agent at a hold.
  Wrench wrench(int hold) const;

  //! Moves a hold by a unit [m], or [m] of any other size: everything is linear.
  void displace(int hold, const Vector3& by);

  //! Turns a hold about its centre by a rotation vector [rad]; no effect on one that is not clamped.
  void turn(int hold, const Vector3& by);

  //! Changes by the last one of them: of a hold's wrench, and of all points [(N + 1) x 3] m.
  Wrench wrenchChange(int hold) const;
  void pointChanges(std::vector<Vector3>& to) const;

 private:
  //! A joint's moment on its first segment, and its derivative by the rotation of the second against the first one.
  struct Moment {
    Vector3 value;
    Eigen::Matrix3d slope;
  };

  Vector3 vector(const AlignedArray& array, int item) const;
  Eigen::Matrix3d columns(const AlignedArray& array, int item) const;
  Eigen::Matrix3d inversePivot(int i) const;
  Quaternion orientation(int i) const;
  double closure(int row, int column) const;
  double twist(int joint) const;
  static Moment bending(const Vector3& a, const Vector3& b, double flexural);
  Moment bending(int joint) const;
  Moment moment(int joint) const;
  Vector3 momentChange(int joint) const;
  Vector3 force(int joint) const;
  Vector3 pull(int i) const;
  Vector3 forceChange(int joint) const;
  int jointsIn(int span, int segment) const;
  bool isCoupled(int i) const;
  Vector3 gapChange(int joint, const Vector3& tangent_change) const;
  Vector3 opening(int joint, const Vector3& tangent_change) const;
  void turnChain(int segment, const Vector3& by);
  void close(std::vector<Vector3>& missing);

  const RodEquilibriumInput& in_;
  const RodEquilibriumLanes& lanes_;
  int lane_;
  std::vector<Vector3> tangents_;       // [N]
  std::vector<Vector3> turns_;          // [N] rad
  std::vector<Vector3> force_changes_;  // [S] N
  int displaced_ = -1;                  // hold; -1: none
  Vector3 displacement_ = Vector3::Zero();
};

}  // namespace pbd
}  // namespace deformable_manipulation
