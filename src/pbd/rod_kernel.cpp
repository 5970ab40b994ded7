// Compiled once per instruction set; see lane_math.h.

#include "rod_kernel.h"

#include "rod_joint.h"

namespace deformable_manipulation {
namespace pbd {
namespace DEFORMABLE_MANIPULATION_ISA {
namespace {

//! The part of the state that one pack of lanes owns, and the constants of the substep.
class PackOfCopies {
 public:
  PackOfCopies(const RodSubstepInput& input, RodLanes& lanes, int first_lane)
      : in_(input),
        s_(lanes),
        lane_(first_lane),
        half_length_(broadcast(0.5 * input.segment_length)),
        inverse_length_(broadcast(1.0 / input.segment_length)),
        compliance_{broadcast(input.bending_compliance), broadcast(input.torsion_compliance),
                    broadcast(input.axial_compliance), broadcast(input.floor_compliance)} {}

  void predict() {
    const Pack h = broadcast(in_.h);
    const Vec3 gravity = broadcast3(in_.gravity);
    for (int i = 0; i < in_.segments; ++i) {
      const Vec3 x = position(i);
      const Quat q = orientation(i);
      store3(&s_.previous_position[at3(i)], kLanes, x);
      store4(&s_.previous_orientation[at4(i)], kLanes, q);
      if (in_.inverse_mass[i] > 0.0) {
        const Vec3 v = load3(&s_.velocity[at3(i)], kLanes) + h * gravity;
        store3(&s_.position[at3(i)], kLanes, x + h * v);
      }
      if (in_.inverse_transverse[i] > 0.0) {
        const Vec3 omega = load3(&s_.angular_velocity[at3(i)], kLanes);
        const Vec3 d = tangentOf(q);
        // Gyroscopic torque of a body of revolution: I^-1 (omega x I omega).
        const Vec3 precession = (in_.inertia_ratio * dot(d, omega)) * cross(omega, d);
        store4(&s_.orientation[at4(i)], kLanes, rotated(q, h * (omega - h * precession)));
      }
    }
    placeHeldSegments();
    for (double *m = s_.multiplier.data() + lane_, *end = s_.multiplier.data() + s_.multiplier.size(); m < end;
         m += kLanes) {
      store(m, Pack{});
    }
  }

  //! One sweep along the chain. Always from the same end: turning round between substeps keeps
  //! the multipliers from settling.
  void sweep() {
    for (int j = 0; j + 1 < in_.segments; ++j) {
      if (in_.joint_active[j]) {
        solveJoint(j);
      }
    }
  }

  //! All joints together: block Cholesky along the chain, then one correction of all segments.
  void solveChain() {
    const int joints = in_.segments - 1;
    eliminate(joints);
    substituteBack(joints);
    correct(joints);
  }

  void updateVelocities() {
    const Pack rate = broadcast(1.0 / in_.h);
    const Pack decay = broadcast(in_.velocity_decay);
    for (int i = 0; i < in_.segments; ++i) {
      const Vec3 v = rate * (position(i) - load3(&s_.previous_position[at3(i)], kLanes));
      const Quat dq = rotationBetween(load4(&s_.previous_orientation[at4(i)], kLanes), orientation(i));
      const Vec3 omega = (2.0 * rate * signOf(dq.w)) * dq.v;
      const Vec3 v_reference = broadcast3(in_.reference_velocity + 3 * i);
      const Vec3 omega_reference = broadcast3(in_.reference_angular_velocity + 3 * i);
      store3(&s_.velocity[at3(i)], kLanes, in_.inverse_mass[i] > 0.0 ? v_reference + decay * (v - v_reference) : v);
      store3(&s_.angular_velocity[at3(i)], kLanes,
             in_.inverse_transverse[i] > 0.0 ? omega_reference + decay * (omega - omega_reference) : omega);
    }
  }

 private:
  int at3(int i) const { return 3 * kLanes * i + lane_; }
  int at4(int i) const { return 4 * kLanes * i + lane_; }

  DM_INLINE Vec3 position(int i) const { return load3(&s_.position[at3(i)], kLanes); }
  DM_INLINE Quat orientation(int i) const { return load4(&s_.orientation[at4(i)], kLanes); }
  DM_INLINE Inverse inverse(int i) const {
    return {broadcast(in_.inverse_mass[i]), broadcast(in_.inverse_transverse[i]), broadcast(in_.inverse_axial[i])};
  }

  DM_INLINE Vec6 multiplier(int j) const {
    Vec6 value;
    for (int k = 0; k < 6; ++k) {
      value.at[k] = load(&s_.multiplier[(6 * j + k) * kLanes + lane_]);
    }
    return value;
  }
  DM_INLINE void storeMultiplier(int j, const Vec6& value) {
    for (int k = 0; k < 6; ++k) {
      store(&s_.multiplier[(6 * j + k) * kLanes + lane_], value.at[k]);
    }
  }

  void placeHeldSegments() {
    for (int n = 0; n < in_.held_count; ++n) {
      const HeldSegment& held = in_.held[n];
      store3(&s_.position[at3(held.segment)], kLanes, load3(held.position + lane_, kLanes));
      if (held.clamped) {
        store4(&s_.orientation[at4(held.segment)], kLanes,
               {broadcast3(held.orientation), broadcast(held.orientation[3])});
      }
    }
  }

  void solveJoint(int j) {
    const Joint joint = jointOf(orientation(j), orientation(j + 1), inverse_length_);
    const Vec6 previous = multiplier(j);
    const Vec6 yielded = applyCompliance(compliance_, joint, previous);
    const Vec6 c = constraintOf(joint, position(j), position(j + 1), half_length_);
    Vec6 change;
    for (int k = 0; k < 6; ++k) {
      change.at[k] = -c.at[k] - yielded.at[k];
    }
    const Inverse i0 = inverse(j);
    const Inverse i1 = inverse(j + 1);
    Triangle6 matrix = jointMatrix(joint, i0, i1, half_length_, compliance_);
    factorize(matrix);
    solveLower(matrix, change);
    solveUpper(matrix, change);

    Vec6 total;
    for (int k = 0; k < 6; ++k) {
      total.at[k] = previous.at[k] + change.at[k];
    }
    storeMultiplier(j, total);
    const Vec3 force = head(change);
    const Vec3 bent = joint.bTransposed(tail(change));
    move(j, i0, joint.d0, force, half_length_ * cross(joint.d0, force) - bent);
    move(j + 1, i1, joint.d1, broadcast(-1.0) * force, half_length_ * cross(joint.d1, force) + bent);
  }

  //! Moves a segment by an impulse (times h) and an angular impulse (times h).
  DM_INLINE void move(int i, const Inverse& inverse, const Vec3& d, const Vec3& impulse, const Vec3& angular) {
    store3(&s_.position[at3(i)], kLanes, position(i) + inverse.mass * impulse);
    store4(&s_.orientation[at4(i)], kLanes, rotated(orientation(i), applyInverseInertia(inverse, d, angular)));
  }

  // Workspace of the direct solver per joint: factor (21), coupling (36), right-hand side (6).
  static constexpr int kPacksPerJoint = 21 + 36 + 6;
  double* work(int j) const { return in_.workspace + static_cast<std::ptrdiff_t>(j) * kPacksPerJoint * kPackWidth; }
  DM_INLINE Triangle6& factor(int j) const { return *reinterpret_cast<Triangle6*>(work(j)); }
  DM_INLINE Vec6* coupling(int j) const { return reinterpret_cast<Vec6*>(work(j) + 21 * kPackWidth); }
  DM_INLINE Vec6& right(int j) const { return *reinterpret_cast<Vec6*>(work(j) + 57 * kPackWidth); }

  //! Columns of the block between joint j and joint j + 1, which share segment j + 1.
  DM_INLINE void couple(const Joint& joint, const Joint& next, const Inverse& shared, Vec6* columns) const {
    const Vec3& d = joint.d1;
    const Pack zero = {};
    const Pack one = broadcast(1.0);
    const Vec3 unit[3] = {{one, zero, zero}, {zero, one, zero}, {zero, zero, one}};
    const Pack lever = half_length_ * shared.transverse;
    const Pack c2 = half_length_ * lever;
    const Pack along[3] = {d.x, d.y, d.z};
    for (int i = 0; i < 3; ++i) {
      columns[i] = join((c2 - shared.mass) * unit[i] - (c2 * along[i]) * d, lever * joint.b(cross(d, unit[i])));
      const Vec3 t = next.bTransposed(unit[i]);
      columns[3 + i] = join(lever * cross(d, t), broadcast(-1.0) * joint.b(applyInverseInertia(shared, d, t)));
    }
  }

  void eliminate(int joints) {
    Joint next = jointOf(orientation(0), orientation(1), inverse_length_);
    for (int j = 0; j < joints; ++j) {
      const Joint joint = next;
      assemble(j, joint);
      const bool active = in_.joint_active[j];
      if (active && j > 0 && in_.joint_active[j - 1]) {
        subtractPrevious(j);
      }
      if (active) {
        factorize(factor(j));
        solveLower(factor(j), right(j));
      }
      if (j + 1 < joints) {
        next = jointOf(orientation(j + 1), orientation(j + 2), inverse_length_);
        if (active && in_.joint_active[j + 1]) {
          couple(joint, next, inverse(j + 1), coupling(j));
          for (int column = 0; column < 6; ++column) {
            solveLower(factor(j), coupling(j)[column]);
          }
        }
      }
    }
  }

  DM_INLINE void assemble(int j, const Joint& joint) {
    factor(j) = jointMatrix(joint, inverse(j), inverse(j + 1), half_length_, compliance_);
    const Vec6 c = constraintOf(joint, position(j), position(j + 1), half_length_);
    for (int k = 0; k < 6; ++k) {
      right(j).at[k] = -c.at[k];
    }
  }

  DM_INLINE void subtractPrevious(int j) {
    const Vec6* w = coupling(j - 1);
    const Vec6& z = right(j - 1);
    for (int row = 0; row < 6; ++row) {
      for (int column = 0; column <= row; ++column) {
        Pack sum = {};
        for (int k = 0; k < 6; ++k) {
          sum += w[row].at[k] * w[column].at[k];
        }
        factor(j).at[lower(row, column)] -= sum;
      }
      for (int k = 0; k < 6; ++k) {
        right(j).at[row] -= w[row].at[k] * z.at[k];
      }
    }
  }

  void substituteBack(int joints) {
    for (int j = joints - 1; j >= 0; --j) {
      if (!in_.joint_active[j]) {
        continue;
      }
      Vec6 value = right(j);
      if (j + 1 < joints && in_.joint_active[j + 1]) {
        const Vec6 later = multiplier(j + 1);
        for (int column = 0; column < 6; ++column) {
          for (int k = 0; k < 6; ++k) {
            value.at[k] -= coupling(j)[column].at[k] * later.at[column];
          }
        }
      }
      solveUpper(factor(j), value);
      storeMultiplier(j, value);
    }
  }

  //! Moves every segment by the multipliers of the joints before and after it.
  void correct(int joints) {
    Vec6 before = {};
    Vec3 bent_before = {};
    Quat next = orientation(0);
    for (int i = 0; i <= joints; ++i) {
      const Quat q = next;
      const Vec3 d = tangentOf(q);
      Vec6 after = {};
      Vec3 bent_after = {};
      if (i < joints) {
        after = multiplier(i);
        next = orientation(i + 1);
        bent_after = jointOf(q, next, inverse_length_).bTransposed(tail(after));
      }
      move(i, inverse(i), d, head(after) - head(before),
           half_length_ * cross(d, head(before) + head(after)) + bent_before - bent_after);
      before = after;
      bent_before = bent_after;
    }
  }

  const RodSubstepInput& in_;
  RodLanes& s_;
  const int lane_;
  const Pack half_length_;
  const Pack inverse_length_;
  const Compliance compliance_;
};

template <bool direct>
void substep(const RodSubstepInput& input, RodLanes& lanes) {
  for (int lane = 0; lane < kLanes; lane += kPackWidth) {
    PackOfCopies copies(input, lanes, lane);
    copies.predict();
    direct ? copies.solveChain() : copies.sweep();
    copies.updateVelocities();
  }
}

#define DM_TEXT(name) #name
#define DM_NAME_OF(name) DM_TEXT(name)

}  // namespace

RodKernel rodKernel() { return {DM_NAME_OF(DEFORMABLE_MANIPULATION_ISA), substep<false>, substep<true>}; }

}  // namespace DEFORMABLE_MANIPULATION_ISA
}  // namespace pbd
}  // namespace deformable_manipulation
