#pragma once

// Gauss-Seidel: joint by joint along a rod, each with its own 6 x 6 system. With the strain C and its
// change D since the substep began, a viscous joint resists as an elastic one of compliance e alpha with
// the strain e C + (1 - e) D, where e = 1 / (1 + retardation time / h).

#include "rod_pack.h"

namespace deformable_manipulation {
namespace pbd {
namespace DEFORMABLE_MANIPULATION_ISA {

//! Inverse mass and inertia of a segment; zero where held.
struct Inverse {
  Pack mass;
  Pack transverse;
  Pack axial;
};

//! I^-1 v for a segment with tangent d.
DM_INLINE Vec3 applyInverseInertia(const Inverse& inverse, const Vec3& d, const Vec3& v) {
  return scaleAdd((inverse.axial - inverse.transverse) * dot(d, v), d, inverse.transverse * v);
}

//! l times the second part of C: bend across and twist along the first tangent.
struct Strain {
  Quat dq;
  Vec3 d0;
  Vec3 bend;  // k without its part along the tangent
  Vec3 axis;  // u - b
  Pack twist;
  Pack lean;  // of the joint

  DM_INLINE Vec3 value() const { return scaleAdd(twist, d0, broadcast(2.0) * bend); }
  //! l B v, where B is its derivative by the second segment's rotation.
  DM_INLINE Vec3 change(const Vec3& v) const { return scaleAdd(dot(axis, v), d0, crossAdd(v, dq.v, dq.w * v)); }
  //! l B^T v
  DM_INLINE Vec3 pull(const Vec3& v) const { return scaleAdd(dot(d0, v), axis, crossAdd(dq.v, v, dq.w * v)); }
  //! The strain whose pull is v: (B B^T)^-1 B v
  DM_INLINE Vec3 strainFor(const Vec3& v) const {
    const Vec3 u = change(v);
    const Pack twice = 2.0 * lean;
    return scaleAdd((1.0 / twice - 1.0) * dot(d0, u), d0, scaleAdd(twice * dot(bend, u), bend, u));
  }
};

DM_INLINE Strain strainOf(const Joint& joint, const Quat& dq) {
  const Vec3 b = crossAdd(dq.v, joint.d0, dq.w * joint.d0);
  return {dq, joint.d0, scaleAdd(-dot(joint.d0, dq.v), joint.d0, dq.v), joint.axis() - b, joint.twist, joint.lean};
}

template <bool viscous, bool plain>
class RodSweep {
 public:
  RodSweep(const RodSubstepInput& input, RodLanes& lanes, int first_lane)
      : pack_(input, lanes, first_lane), in_(input), half_length_(broadcast(0.5 * input.segment_length)) {}

  //! One sweep along the chain. Always from the same end: turning round between substeps keeps
  //! the multipliers from settling.
  void substep() {
    pack_.predict();
    Placement segment = pack_.placement(0);
    for (int j = 0; j + 1 < in_.segments; ++j) {
      Placement next = pack_.placement(j + 1);
      JointWrench wrench = {};
      if (in_.joint_active[j]) {
        wrench = solve(j, segment, next);
      }
      pack_.storeWrench(j, wrench);
      pack_.finish(j, segment);
      segment = next;
    }
    pack_.finish(in_.segments - 1, segment);
  }

 private:
  DM_INLINE Inverse inverseOf(int i) const {
    return {broadcast(in_.inverse_mass[i]), broadcast(in_.inverse_transverse[i]), broadcast(in_.inverse_axial[i])};
  }

  //! Moves the two segments of joint j so that it holds.
  DM_INLINE JointWrench solve(int j, Placement& first, Placement& second) {
    const JointStiffness& stiffness = in_.joints[j];
    Inverse i0 = inverseOf(j);
    Inverse i1 = inverseOf(j + 1);
    Joint joint = pack_.joint(j, first.q, tangentOf(first.q), second.q, tangentOf(second.q));
    Strain strain = strainOf(joint, rotationBetween(first.q, second.q));
    const Pack arm0 = armAfter(j);
    const Pack arm1 = armBefore(j + 1);
    const Pack lever0 = arm0 * i0.transverse;
    const Pack lever1 = arm1 * i1.transverse;

    // [ X  Y^T ; Y  Z ] [ force ; moment ] = -[ gap ; strain ], the second row times l.
    const Pack mass = i0.mass + i1.mass + in_.floor_compliance;
    const Pack turning = plain ? half_length_ * (lever0 + lever1) : arm0 * lever0 + arm1 * lever1;
    Symmetric3 x = addOuter(addOuter(isotropic(mass + turning), stiffness.axial_compliance - arm0 * lever0, joint.d0),
                            -arm1 * lever1, joint.d1);
    Matrix3 levers = crossMatrix(lever1 * joint.d1 - lever0 * joint.d0);
    Matrix3 y = {strain.change(levers.x), strain.change(levers.y), strain.change(levers.z)};
    const Pack transverse = i0.transverse + i1.transverse;
    Symmetric3 z = addOuter(isotropic(transverse + stiffness.bending_compliance), -transverse, strain.bend);
    z = addOuter(z, i0.axial - i0.transverse, strain.change(joint.d0));
    z = addOuter(z, i1.axial - i1.transverse, strain.change(joint.d1));
    z = addOuter(z,
                 transverse * (2.0 * joint.lean - 1.0) + (stiffness.torsion_compliance - stiffness.bending_compliance),
                 joint.d0);

    // Force first: x^-1 y^T, then what is left for the moment.
    Symmetric3 p = inverse(x);
    Vec3 gap = plain ? gapOf(joint, first.x, second.x, half_length_) : pack_.unevenGap(j, joint, first.x, second.x);
    Matrix3 v = y * p;
    Symmetric3 q = inverse(z - multiplyTransposedAdd(v, y, Symmetric3{}));
    Vec3 resisted = strain.value();
    if (!plain && in_.natural_ahead != nullptr) {
      resisted = naturalStrain(strain, joint, pack_.naturalJoint(j, first.q, second.q));
    }
    if (viscous) {
      Vec3 change = turnToCome(j + 1, i1, joint.d1) - pack_.turnedSince(j, first.q);
      resisted = resistedStrain(stiffness, strain, resisted, pack_.turnedSince(j + 1, second.q) + change);
    }
    Vec3 moment = q * multiplyAdd(v, gap, -resisted);
    Vec3 force = -transposedMultiplyAdd(v, moment, p * gap);

    Vec3 torque = -strain.pull(moment);
    move(j, first, i0, joint.d0, force, crossAdd(arm0 * joint.d0, force, torque));
    move(j + 1, second, i1, joint.d1, -force, crossAdd(arm1 * joint.d1, force, -torque));
    return {force, torque};
  }

  //! How far the joint after a segment will turn it, as in the last substep: a rod at rest has no rate of strain.
  DM_INLINE Vec3 turnToCome(int i, const Inverse& inverse, const Vec3& d) const {
    JointWrench next = pack_.lastWrench(i);
    return applyInverseInertia(inverse, d, crossAdd(armAfter(i) * d, next.force, next.torque));
  }

  //! From the joint before a segment to its position, and from there to the joint after it.
  DM_INLINE Pack armBefore(int i) const { return plain ? half_length_ : broadcast(in_.arm_before[i]); }
  DM_INLINE Pack armAfter(int i) const { return plain ? half_length_ : broadcast(in_.arm_after[i]); }

  //! l times the strain of a joint with a natural shape: that of the torque of its pairs. What of this is along the
  //! tangent meets the compliance of twist.
  DM_INLINE Vec3 naturalStrain(const Strain& strain, const Joint& joint, const NaturalJoint& natural) const {
    Vec3 pairs = crossAdd(natural.c0, joint.d1, cross(joint.d0, natural.c1));
    Vec3 more = strain.strainFor(broadcast(0.5) * pairs - joint.normal);
    const Pack along = (in_.bending_over_torsion - 1.0) * dot(strain.d0, more) - natural.twist;
    return strain.value() + scaleAdd(along, strain.d0, more);
  }

  //! The elastic part of the strain, and the viscous part of its change.
  DM_INLINE Vec3 resistedStrain(const JointStiffness& stiffness, const Strain& strain, const Vec3& elastic,
                                const Vec3& rotation) const {
    Vec3 change = strain.change(rotation);
    Vec3 rest = elastic - change;
    const Pack bending = broadcast(stiffness.bending_elasticity);
    const Pack torsion = stiffness.torsion_elasticity - bending;
    return change + scaleAdd(torsion * dot(strain.d0, rest), strain.d0, bending * rest);
  }

  //! Moves a segment by an impulse (times h) and an angular impulse (times h).
  DM_INLINE void move(int i, Placement& place, const Inverse& inverse, const Vec3& d, const Vec3& impulse,
                      const Vec3& angular) {
    place.x = scaleAdd(inverse.mass, impulse, place.x);
    if (in_.inverse_transverse[i] > 0.0) {
      place.q = rotated(place.q, broadcast(0.5) * applyInverseInertia(inverse, d, angular));
    }
  }

  RodPack pack_;
  const RodSubstepInput& in_;
  const Pack half_length_;
};

}  // namespace DEFORMABLE_MANIPULATION_ISA
}  // namespace pbd
}  // namespace deformable_manipulation
