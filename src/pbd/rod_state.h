#pragma once

#include <memory>
#include <vector>

#include "deformable_manipulation/pbd/rod.h"
#include "deformable_manipulation/pbd/rod_equilibrium.h"
#include "lane_groups.h"
#include "reference_motion.h"
#include "rod_kernel.h"

namespace deformable_manipulation {
namespace pbd {

inline Quaternion read4(const AlignedArray& array, int item, int lane) {
  const double* at = array.data() + 4 * kLanes * item + lane;
  return {at[3 * kLanes], at[0], at[kLanes], at[2 * kLanes]};
}

inline void write4(AlignedArray& array, int item, int lane, const Quaternion& value) {
  for (int i = 0; i < 4; ++i) {
    array[(4 * item + i) * kLanes + lane] = value.coeffs()[i];
  }
}

inline Vector3 tangent(const Quaternion& orientation) { return orientation * Vector3::UnitX(); }

//! All that changes of a rod, and the kernel's input.
struct Rod::State {
  explicit State(int segments) : groups(RodLanes(segments)) {}

  LaneGroups<RodLanes, HeldSegment> groups;
  std::vector<double> inverse_mass, inverse_transverse, inverse_axial;
  std::vector<double> transverse_inertia, inertia_excess, inertia_ratio, drag;
  std::vector<double> places;          // [N] of the segments' centres, in usual lengths from the first one's
  std::vector<JointStiffness> joints;  // [N - 1]
  std::vector<double> weight_moment, arm_before, arm_after;
  std::vector<double> offset;  // [N] m, from a segment's centre to its position in the lanes, along its tangent
  std::vector<unsigned char> joint_active;
  std::vector<double> linear_rate, angular_rate;
  std::vector<double> reference_velocity, reference_angular_velocity;
  AlignedArray workspace;  // [threads x rodWorkspaceSize()]
  RodSubstepInput input;
  RodSubstep solve;
  std::shared_ptr<ThreadPool> pool;    // shared with clones
  std::vector<SegmentMotion> motions;  // [N] scratch
  RodEquilibrium equilibrium;

  //! Points the kernel's input at this state's arrays.
  void connect() {
    input.inverse_mass = inverse_mass.data();
    input.inverse_transverse = inverse_transverse.data();
    input.inverse_axial = inverse_axial.data();
    input.transverse_inertia = transverse_inertia.data();
    input.inertia_excess = inertia_excess.data();
    input.inertia_ratio = inertia_ratio.data();
    input.drag = drag.data();
    input.joints = joints.data();
    input.weight_moment = weight_moment.data();
    input.arm_before = arm_before.data();
    input.arm_after = arm_after.data();
    input.joint_active = joint_active.data();
    input.linear_rate = linear_rate.data();
    input.angular_rate = angular_rate.data();
    input.reference_velocity = reference_velocity.data();
    input.reference_angular_velocity = reference_angular_velocity.data();
  }
};

}  // namespace pbd
}  // namespace deformable_manipulation
