#pragma once

// Direct solver: all joints of a rod at once.
//
// Unknown are the rotation th_i of every segment and the force f_j in every joint, times h^2.
// Bending and twisting are stiffnesses K_j between rotations; zero stretch is what the forces are
// there for. With d the tangents, l the segment length and C_j the gap of joint j,
//
//   I_i th_i = l/2 d_i x (f_i-1 + f_i) + s_i - s_i-1,        s_j = K_j (th_j+1 - th_j) + sigma_j,
//   C_j + (f_j - f_j-1) / m_j - (f_j+1 - f_j) / m_j+1 + compliance f_j
//       - l/2 d_j x th_j - l/2 d_j+1 x th_j+1 = 0.
//
// They are eliminated in the order th_0, f_0, th_1, f_1, ..., in blocks of 3 x 3 which are all
// positive definite, and found in the opposite order. A held segment has no inverse mass, a
// clamped one a huge inertia. Viscous joints add their viscosity to K_j, and to sigma_j its product
// with the rotation predicted. See docs/mathematics.md, whose symbols are used here.

#include "rod_pack.h"

namespace deformable_manipulation {
namespace pbd {
namespace DEFORMABLE_MANIPULATION_ISA {

//! Torque of a joint on its first segment: sigma + K (th_1 - th_0).
struct Elasticity {
  Symmetric3 k;
  Vec3 sigma;
};

//! K of a joint with these stiffnesses.
DM_INLINE Symmetric3 stiffnessOf(const Joint& joint, double bending, double torsion) {
  const Pack lean = joint.lean;
  const Pack relief = (-0.5 * bending) * lean;
  return addOuter(addOuter(isotropic(broadcast(bending)), relief, joint.normal), relief + lean * (torsion * lean),
                  joint.sum);
}

DM_INLINE Elasticity elasticityOf(const Joint& joint, double bending, double torsion) {
  const Pack torque = torsion * joint.lean;  // per twist
  return {stiffnessOf(joint, bending, torsion),
          scaleAdd(torque * joint.twist, joint.sum, broadcast(bending) * joint.normal)};
}

//! K of one of the pairs of a joint with a natural shape, as that of two tangents.
DM_INLINE Symmetric3 pairStiffness(const Vec3& a, const Vec3& b, const Pack& bending) {
  const Pack relief = (-0.5 * bending) * reciprocal(largerOf(1.0 + dot(a, b), broadcast(kLeastLean)));
  return addOuter(addOuter(isotropic(bending), relief, cross(a, b)), relief, a + b);
}

DM_INLINE Elasticity naturalElasticity(const Joint& joint, const NaturalJoint& natural, double bending,
                                       double torsion) {
  const Pack half = broadcast(0.5 * bending);
  const Vec3 axis = joint.axis();
  const Vec3 moment = crossAdd(natural.c0, joint.d1, cross(joint.d0, natural.c1));
  return {addOuter(pairStiffness(natural.c0, joint.d1, half) + pairStiffness(joint.d0, natural.c1, half),
                   broadcast(torsion), axis),
          scaleAdd(torsion * (joint.twist - natural.twist), axis, half * moment)};
}

//! Adds the torque that resists the rotation of the second segment against the first one: predicted, and to come.
DM_INLINE void addViscosity(Elasticity& elasticity, const Symmetric3& viscosity, const Vec3& rotation) {
  elasticity.k = elasticity.k + viscosity;
  elasticity.sigma = multiplyAdd(viscosity, rotation, elasticity.sigma);
}

//! The next segment and the joint after it, as they are once all before them is eliminated:
//! A th - R f = torque + ..., R^T th + N f = -gap + ...
struct ChainFront {
  Placement segment;
  Vec3 tangent;
  Symmetric3 a;
  Vec3 torque;
  Matrix3 r;
  Symmetric3 n;  // without what the joint itself adds
  Vec3 gap;      // likewise
};

//! Rotation of a segment and force in the joint after it.
struct ChainSolution {
  Vec3 rotation;
  Vec3 force;
};

template <bool viscous, bool plain>
class RodChain {
 public:
  RodChain(const RodSubstepInput& input, RodLanes& lanes, int first_lane)
      : pack_(input, lanes, first_lane), in_(input), half_length_(broadcast(0.5 * input.segment_length)) {}

  void substep() {
    pack_.predict();
    const int joints = in_.segments - 1;
    ChainFront front = begin();
    for (int j = 0; j < joints; ++j) {
      front = eliminate(j, front);
    }
    ChainSolution solution = {inverse(front.a) * front.torque, Vec3{}};
    for (int j = joints - 1; j >= 0; --j) {
      solution = substitute(j, solution);
    }
    Placement first = turned(0, solution.rotation);
    first.x = scaleAdd(broadcast(in_.inverse_mass[0]), solution.force, first.x);
    pack_.finish(0, first);
  }

 private:
  DM_INLINE ChainFront begin() const {
    Placement segment = pack_.placement(0);
    Vec3 d = tangentOf(segment.q);
    return {segment, d, inertia(0, d), Vec3{}, crossMatrix(armAfter(0) * d), Symmetric3{}, Vec3{}};
  }

  //! Eliminates the rotation of segment j and the force of joint j.
  DM_INLINE ChainFront eliminate(int j, const ChainFront& front) const {
    const bool active = in_.joint_active[j];
    Placement next = pack_.placement(j + 1);
    Vec3 d = tangentOf(next.q);
    Joint joint = pack_.joint(j, front.segment.q, front.tangent, next.q, d);
    Elasticity elasticity = elasticityAt(j, joint, front.segment.q, next.q);
    if (viscous && active) {
      addViscosity(elasticity, stiffnessOf(joint, in_.joints[j].bending_viscosity, in_.joints[j].torsion_viscosity),
                   pack_.turnedSince(j + 1, next.q) - pack_.turnedSince(j, front.segment.q));
    }

    // th = A^-1 (torque + R f + K th')
    const Symmetric3& k = elasticity.k;
    Symmetric3 a_inverse = inverse(front.a + k);
    Vec3 torque = front.torque + elasticity.sigma;
    PackWriter keep(kept(j));
    keep.put(a_inverse);
    keep.put(torque);
    keep.put(front.r);
    keep.put(k);
    keep.put(elasticity.sigma);

    // f = P (f' / m' - gap - H^T th'), with V = H P
    Vec3 turn = a_inverse * torque;
    Vec3 gap = transposedMultiplyAdd(front.r, turn, front.gap + gapAt(j, joint, front.segment.x, next.x));
    Matrix3 a_inverse_r = a_inverse * front.r;
    Symmetric3 n = addOuter(transposedMultiplyAdd(front.r, a_inverse_r, front.n + compliance(j)),
                            broadcast(in_.joints[j].axial_compliance), joint.d0);
    Matrix3 lever = crossMatrix(armBefore(j + 1) * d);
    Matrix3 h = multiplyAdd(k, a_inverse_r, lever);
    Symmetric3 p = active ? inverse(n) : Symmetric3{};
    Symmetric3 series = k - transposedTimesSymmetric(toMatrix(k), a_inverse * toMatrix(k));
    Matrix3 v = h * p;
    Vec3 force = p * gap;
    keep.put(p);
    keep.put(v);
    keep.put(force);

    const Pack inverse_mass = broadcast(in_.inverse_mass[j + 1]);
    return {next,
            d,
            multiplyTransposedAdd(v, h, inertia(j + 1, d) + series),
            multiplyAdd(h, -force, multiplyAdd(k, turn, -elasticity.sigma)),
            multiplyAdd(inverse_mass, v, plain ? lever : crossMatrix(armAfter(j + 1) * d)),
            (-inverse_mass * inverse_mass) * p,
            inverse_mass * force};
  }

  //! Finds the force of joint j and the rotation of segment j, and moves segment j + 1.
  DM_INLINE ChainSolution substitute(int j, const ChainSolution& after) {
    Placement moved = turned(j + 1, after.rotation);
    PackReader kept_here(kept(j));
    Symmetric3 a_inverse = kept_here.getSymmetric3();
    Vec3 torque = kept_here.getVec3();
    Matrix3 r = kept_here.getMatrix3();
    Symmetric3 k = kept_here.getSymmetric3();
    Vec3 sigma = kept_here.getVec3();
    Symmetric3 p = kept_here.getSymmetric3();
    Matrix3 v = kept_here.getMatrix3();
    Vec3 gap_force = kept_here.getVec3();

    const Pack inverse_mass = broadcast(in_.inverse_mass[j + 1]);
    Vec3 force = transposedMultiplyAdd(v, -after.rotation, multiplyAdd(p, inverse_mass * after.force, -gap_force));
    Vec3 pull = k * after.rotation;
    Vec3 rotation = a_inverse * multiplyAdd(r, force, torque + pull);
    pack_.storeWrench(j, {force, multiplyAdd(k, -rotation, sigma + pull)});
    moved.x = scaleAdd(inverse_mass, after.force - force, moved.x);
    pack_.finish(j + 1, moved);
    return {rotation, force};
  }

  //! Inertia, and what tension resists to turning across the axis (geometric stiffness, times h^2). Without it a
  //! chain pulled taut would swing ever wider.
  DM_INLINE Symmetric3 inertia(int i, const Vec3& d) const {
    Pack tension = plain ? half_length_ * dot(d, pack_.lastForce(i - 1) + pack_.lastForce(i))
                         : armBefore(i) * dot(d, pack_.lastForce(i - 1)) + armAfter(i) * dot(d, pack_.lastForce(i));
    tension = tension > Pack{} ? tension : Pack{};
    return addOuter(isotropic(broadcast(in_.transverse_inertia[i]) + tension),
                    broadcast(in_.inertia_excess[i]) - tension, d);
  }

  //! From the joint before a segment to its position, and from there to the joint after it.
  DM_INLINE Pack armBefore(int i) const { return plain ? half_length_ : broadcast(in_.arm_before[i]); }
  DM_INLINE Pack armAfter(int i) const { return plain ? half_length_ : broadcast(in_.arm_after[i]); }

  DM_INLINE Vec3 gapAt(int j, const Joint& joint, const Vec3& x0, const Vec3& x1) const {
    return plain ? gapOf(joint, x0, x1, half_length_) : pack_.unevenGap(j, joint, x0, x1);
  }

  DM_INLINE Elasticity elasticityAt(int j, const Joint& joint, const Quat& q0, const Quat& q1) const {
    const double bending = in_.joint_active[j] ? in_.joints[j].bending_stiffness : 0.0;
    const double torsion = in_.joint_active[j] ? in_.joints[j].torsion_stiffness : 0.0;
    if (plain || in_.natural_ahead == nullptr) {
      return elasticityOf(joint, bending, torsion);
    }
    return naturalElasticity(joint, pack_.naturalJoint(j, q0, q1), bending, torsion);
  }

  //! What joint j yields to its own force, but for stretch.
  DM_INLINE Symmetric3 compliance(int j) const {
    return isotropic(broadcast(in_.inverse_mass[j] + in_.inverse_mass[j + 1] + in_.floor_compliance));
  }

  //! A segment's prediction, turned.
  DM_INLINE Placement turned(int i, const Vec3& rotation) const {
    Placement place = pack_.placement(i);
    if (in_.inverse_transverse[i] > 0.0) {
      place.q = rotated(place.q, broadcast(0.5) * rotation);
    }
    return place;
  }

  //! What is kept of joint j and segment j to find their force and rotation later.
  DM_INLINE double* kept(std::ptrdiff_t j) const { return in_.workspace + j * kNumbersPerJoint * kPackWidth; }

  RodPack pack_;
  const RodSubstepInput& in_;
  const Pack half_length_;
};

}  // namespace DEFORMABLE_MANIPULATION_ISA
}  // namespace pbd
}  // namespace deformable_manipulation
