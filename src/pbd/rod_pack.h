#pragma once

// One pack of copies of a rod: access to its part of the state, and what a substep does before
// and after the joints are solved.

#include "rod_joint.h"
#include "rod_kernel.h"

namespace deformable_manipulation {
namespace pbd {
namespace DEFORMABLE_MANIPULATION_ISA {

//! Where a segment is.
struct Placement {
  Vec3 x;
  Quat q;
};

//! What the second segment of a joint exerts on the first, times h^2.
struct JointWrench {
  Vec3 force;
  Vec3 torque;
};

class RodPack {
 public:
  RodPack(const RodSubstepInput& input, RodLanes& lanes, int first_lane)
      : in_(input),
        position_(lanes.position.data() + first_lane),
        previous_position_(lanes.previous_position.data() + first_lane),
        velocity_(lanes.velocity.data() + first_lane),
        orientation_(lanes.orientation.data() + first_lane),
        previous_orientation_(lanes.previous_orientation.data() + first_lane),
        angular_velocity_(lanes.angular_velocity.data() + first_lane),
        multiplier_(lanes.multiplier.data() + first_lane),
        twist_(lanes.twist.data() + first_lane),
        first_lane_(first_lane) {}

  //! How far the two segments' ends at joint j are apart, where their arms may differ.
  DM_INLINE Vec3 unevenGap(int j, const Joint& joint, const Vec3& x0, const Vec3& x1) const {
    return scaleAdd(broadcast(in_.arm_after[j]), joint.d0,
                    scaleAdd(broadcast(in_.arm_before[j + 1]), joint.d1, x0 - x1));
  }

  //! The vectors that joint j between two orientations brings together; for rods that are not straight by nature.
  DM_INLINE NaturalJoint naturalJoint(std::ptrdiff_t j, const Quat& q0, const Quat& q1) const {
    return {rotatedBy(q0, broadcast3(in_.natural_ahead + 3 * j)), rotatedBy(q1, broadcast3(in_.natural_behind + 3 * j)),
            broadcast(in_.natural_twist[j])};
  }

  DM_INLINE Placement placement(int i) const {
    return {load3(position_ + at3(i), kLanes), load4(orientation_ + at4(i), kLanes)};
  }

  //! Force of joint j on its first segment in the last substep, times h^2; none beyond the ends.
  DM_INLINE Vec3 lastForce(int j) const {
    return j >= 0 && j + 1 < in_.segments ? load3(multiplier_ + 2 * at3(j), kLanes) : Vec3{};
  }

  //! The same with its torque.
  DM_INLINE JointWrench lastWrench(int j) const {
    if (j < 0 || j + 1 >= in_.segments) {
      return JointWrench{Vec3{}, Vec3{}};
    }
    const double* from = multiplier_ + 2 * at3(j);
    return {load3(from, kLanes), load3(from + 3 * kLanes, kLanes)};
  }

  DM_INLINE void storeWrench(int j, const JointWrench& wrench) {
    double* to = multiplier_ + 2 * at3(j);
    store3(to, kLanes, wrench.force);
    store3(to + 3 * kLanes, kLanes, wrench.torque);
  }

  //! Joint j between two segments and their tangents; keeps count of its turns.
  DM_INLINE Joint joint(std::ptrdiff_t j, const Quat& q0, const Vec3& d0, const Quat& q1, const Vec3& d1) const {
    double* twist = twist_ + kLanes * j;
    Joint joint = jointBetween(q0, d0, q1, d1, load(twist));
    store(twist, joint.twist);
    return joint;
  }

  //! How far a segment, which now is at an orientation, has turned since the substep began.
  DM_INLINE Vec3 turnedSince(int i, const Quat& q) const {
    Quat turned = rotationBetween(load4(previous_orientation_ + at4(i), kLanes), q);
    return (2.0 * signOf(turned.w)) * turned.v;
  }

  //! Moves all segments as if there were no joints, and the held ones to where they are held.
  void predict() {
    for (int i = 0; i < in_.segments; ++i) {
      predict(i);
    }
    for (int n = 0; n < in_.held_count; ++n) {
      place(in_.held[n]);
    }
  }

  //! Stores where a segment is at the end of the substep, and its velocity.
  DM_INLINE void finish(int i, const Placement& end) {
    Vec3 moved = end.x - load3(previous_position_ + at3(i), kLanes);
    Quat turned = rotationBetween(load4(previous_orientation_ + at4(i), kLanes), end.q);
    const Pack angular_rate = 2.0 * in_.angular_rate[i] * signOf(turned.w);
    store3(position_ + at3(i), kLanes, end.x);
    store4(orientation_ + at4(i), kLanes, end.q);
    store3(velocity_ + at3(i), kLanes,
           scaleAdd(broadcast(in_.linear_rate[i]), moved, broadcast3(in_.reference_velocity + 3 * i)));
    store3(angular_velocity_ + at3(i), kLanes,
           scaleAdd(angular_rate, turned.v, broadcast3(in_.reference_angular_velocity + 3 * i)));
  }

 private:
  static std::ptrdiff_t at3(std::ptrdiff_t i) { return 3 * kLanes * i; }
  static std::ptrdiff_t at4(std::ptrdiff_t i) { return 4 * kLanes * i; }

  DM_INLINE void predict(int i) {
    const Pack h = broadcast(in_.h);
    Placement start = placement(i);
    store3(previous_position_ + at3(i), kLanes, start.x);
    store4(previous_orientation_ + at4(i), kLanes, start.q);
    if (in_.inverse_mass[i] > 0.0) {
      Vec3 v = scaleAdd(h, broadcast3(in_.gravity), load3(velocity_ + at3(i), kLanes));
      if (in_.drag[i] > 0.0) {
        v = slowed(in_.drag[i], v, tangentOf(start.q));
      }
      store3(position_ + at3(i), kLanes, scaleAdd(h, v, start.x));
    }
    if (in_.inverse_transverse[i] > 0.0) {
      Vec3 omega = load3(angular_velocity_ + at3(i), kLanes);
      Vec3 d = tangentOf(start.q);
      // Gyroscopic torque of a body of revolution: I^-1 (omega x I omega).
      Vec3 precession = (in_.inertia_ratio[i] * dot(d, omega)) * cross(omega, d);
      if (in_.weight_moment[i] != 0.0) {
        const Pack rate = broadcast(in_.h * in_.inverse_transverse[i] * in_.weight_moment[i]);
        omega = scaleAdd(rate, cross(d, broadcast3(in_.gravity)), omega);
      }
      store4(orientation_ + at4(i), kLanes, rotated(start.q, (0.5 * h) * scaleAdd(-h, precession, omega)));
    }
  }

  //! Velocity after the drag of a substep, which is implicit in the speed.
  DM_INLINE Vec3 slowed(double drag, const Vec3& v, const Vec3& tangent) const {
    Vec3 across = scaleAdd(-dot(v, tangent), tangent, v);
    const Pack loss = (drag * in_.h) * squareRoot(dot(across, across));
    return scaleAdd(-loss / (1.0 + loss), across, v);
  }

  void place(const HeldSegment& held) {
    store3(position_ + at3(held.segment), kLanes, load3(held.position + first_lane_, kLanes));
    if (held.clamped) {
      store4(orientation_ + at4(held.segment), kLanes, {broadcast3(held.orientation), broadcast(held.orientation[3])});
    }
  }

  const RodSubstepInput& in_;
  double* const position_;
  double* const previous_position_;
  double* const velocity_;
  double* const orientation_;
  double* const previous_orientation_;
  double* const angular_velocity_;
  double* const multiplier_;
  double* const twist_;
  const int first_lane_;
};

}  // namespace DEFORMABLE_MANIPULATION_ISA
}  // namespace pbd
}  // namespace deformable_manipulation
