#pragma once

// Direct solver: all joints of a rod at once.
//
// Unknown are the rotation of every segment and the force in every joint; bending and twisting
// are stiffnesses between rotations, zero stretch is what the forces are there for:
//
//   I_i th_i = l/2 d_i x (f_i + f_i-1) + s_i - s_i-1,        s_j = K_j (th_j+1 - th_j) + sigma_j,
//   gap_j + m_j^-1 (f_j - f_j-1) - m_j+1^-1 (f_j+1 - f_j) + compliance f_j
//         - l/2 d_j x th_j - l/2 d_j+1 x th_j+1 = 0.
//
// They are eliminated from the first segment to the last in the order th_0, f_0, th_1, f_1, ...,
// in blocks of 3 x 3, all of them positive definite, and found in the opposite order. A clamped
// segment has a huge inertia, a held one no inverse mass. See docs/mathematics.md.

#include "rod_pack.h"

namespace deformable_manipulation {
namespace pbd {
namespace DEFORMABLE_MANIPULATION_ISA {

//! Torque between two segments: sigma + K (th_1 - th_0).
struct Elasticity {
  Symmetric3 stiffness;
  Vec3 torque;
};

DM_INLINE Elasticity elasticityOf(const Joint& joint, double bending, double torsion) {
  Vec3 axis = joint.bTransposed(joint.d0);  // of twist
  const Pack excess = broadcast(torsion - bending);
  return {addOuter(addOuter(isotropic(broadcast(bending)), broadcast(-bending), joint.k), excess, axis),
          scaleAdd(2.0 * excess * dot(joint.d0, joint.k), axis, (2.0 * bending * joint.w) * joint.k)};
}

//! The chain as the segment and the joint that come next feel it, all before being eliminated:
//! A th - R f = torque, R^T th + N f = -gap.
struct ChainFront {
  Placement segment;
  Vec3 tangent;
  Symmetric3 inertia;     // A
  Vec3 torque;
  Matrix3 lever;          // R
  Symmetric3 mobility;    // N
  Vec3 gap;
};

//! Solution at the segment after a joint.
struct ChainSolution {
  Vec3 rotation;
  Vec3 force;  // in the joint after that segment
};

class RodChain {
 public:
  RodChain(const RodSubstepInput& input, RodLanes& lanes, int first_lane)
      : pack_(input, lanes, first_lane),
        in_(input),
        workspace_(input.workspace + first_lane * kNumbersPerJoint),
        half_length_(broadcast(0.5 * input.segment_length)) {}

  void predict() { pack_.predict(); }

  DM_INLINE ChainFront begin() const {
    Placement segment = pack_.placement(0);
    Vec3 tangent = tangentOf(segment.q);
    return {segment, tangent, inertia(0, tangent), Vec3{}, crossMatrix(half_length_ * tangent), Symmetric3{}, Vec3{}};
  }

  //! Eliminates the rotation of segment j and the force of joint j.
  DM_INLINE ChainFront eliminate(int j, const ChainFront& front) const {
    Placement next = pack_.placement(j + 1);
    Vec3 tangent = tangentOf(next.q);
    Joint joint = jointBetween(front.segment.q, front.tangent, next.q, tangent);
    const bool active = in_.joint_active[j];
    Elasticity elasticity = elasticityOf(joint, active ? in_.bending_stiffness : 0.0, active ? in_.torsion_stiffness : 0.0);

    Symmetric3 a = inverse(front.inertia + elasticity.stiffness);
    Vec3 torque = front.torque + elasticity.torque;
    PackWriter keep(kept(j));
    keep.put(a);
    keep.put(torque);
    keep.put(elasticity.stiffness);
    keep.put(elasticity.torque);
    keep.put(front.lever);

    const Symmetric3& k = elasticity.stiffness;
    Vec3 turn = a * torque;
    Vec3 gap = transposedMultiplyAdd(front.lever, turn, front.gap + gapOf(joint, front.segment.x, next.x, half_length_));
    Matrix3 u = a * front.lever;
    const Pack mass = broadcast(in_.inverse_mass[j] + in_.inverse_mass[j + 1] + in_.floor_compliance);
    Symmetric3 mobility = transposedMultiplyAdd(front.lever, u, front.mobility + isotropic(mass));
    if (in_.axial_compliance > 0.0) {
      mobility = addOuter(mobility, broadcast(in_.axial_compliance), joint.d0);
    }
    Matrix3 arm = crossMatrix(half_length_ * tangent);
    Matrix3 h = multiplyAdd(k, u, arm);
    Symmetric3 p = active ? inverse(mobility) : Symmetric3{};
    Symmetric3 next_inertia = inertia(j + 1, tangent) + k - transposedMultiplyAdd(toMatrix(k), a * toMatrix(k), Symmetric3{});
    Matrix3 v = h * p;
    Vec3 force = p * gap;
    keep.put(p);
    keep.put(v);
    keep.put(force);

    const Pack inverse_mass = broadcast(in_.inverse_mass[j + 1]);
    return {next,
            tangent,
            multiplyTransposedAdd(v, h, next_inertia),
            multiplyAdd(h, -force, multiplyAdd(k, turn, -elasticity.torque)),
            multiplyAdd(inverse_mass, v, arm),
            (-inverse_mass * inverse_mass) * p,
            inverse_mass * force};
  }

  //! Solves for the last segment, which no joint follows.
  DM_INLINE ChainSolution solveLast(const ChainFront& front) const {
    return {inverse(front.inertia) * front.torque, Vec3{}};
  }

  //! Finds the force of joint j and the rotation of segment j, and moves segment j + 1.
  DM_INLINE ChainSolution substitute(int j, const ChainSolution& after) {
    PackReader kept_values(kept(j));
    Symmetric3 a = kept_values.getSymmetric3();
    Vec3 torque = kept_values.getVec3();
    Symmetric3 stiffness = kept_values.getSymmetric3();
    Vec3 elastic_torque = kept_values.getVec3();
    Matrix3 lever = kept_values.getMatrix3();
    Symmetric3 p = kept_values.getSymmetric3();
    Matrix3 v = kept_values.getMatrix3();
    Vec3 gap_force = kept_values.getVec3();
    const Pack inverse_mass = broadcast(in_.inverse_mass[j + 1]);
    Vec3 force = transposedMultiplyAdd(v, -after.rotation, multiplyAdd(p, inverse_mass * after.force, -gap_force));
    Vec3 pull = stiffness * after.rotation;
    Vec3 rotation = a * multiplyAdd(lever, force, torque + pull);
    pack_.storeWrench(j, {force, multiplyAdd(stiffness, -rotation, elastic_torque + pull)});
    move(j + 1, inverse_mass * (after.force - force), after.rotation);
    return {rotation, force};
  }

  //! Moves segment 0, when the force of joint 0 is known.
  DM_INLINE void moveFirst(const ChainSolution& solution) {
    move(0, broadcast(in_.inverse_mass[0]) * solution.force, solution.rotation);
  }

 private:
  DM_INLINE Symmetric3 inertia(int i, const Vec3& d) const {
    return addOuter(isotropic(broadcast(in_.transverse_inertia[i])), broadcast(in_.inertia_excess[i]), d);
  }

  DM_INLINE void move(int i, const Vec3& shift, const Vec3& rotation) {
    Placement place = pack_.placement(i);
    place.x = place.x + shift;
    if (in_.inverse_transverse[i] > 0.0) {
      place.q = rotated(place.q, broadcast(0.5) * rotation);
    }
    pack_.finish(i, place);
  }

  double* kept(int j) const { return workspace_ + static_cast<std::ptrdiff_t>(j) * kNumbersPerJoint * kLanes; }

  RodPack pack_;
  const RodSubstepInput& in_;
  double* const workspace_;
  const Pack half_length_;
};

}  // namespace DEFORMABLE_MANIPULATION_ISA
}  // namespace pbd
}  // namespace deformable_manipulation
