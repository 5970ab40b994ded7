// Compiled once per instruction set; see lane_math.h.

#include "rod_equilibrium_kernel.h"

#include "rod_joint.h"

namespace deformable_manipulation {
namespace pbd {
namespace DEFORMABLE_MANIPULATION_ISA {
namespace {

//! s (a b^T + b a^T) / 2
DM_INLINE Symmetric3 symmetricProduct(const Pack& s, const Vec3& a, const Vec3& b) {
  const Pack half = 0.5 * s;
  return {s * a.x * b.x,
          half * (a.y * b.x + a.x * b.y),
          s * a.y * b.y,
          half * (a.z * b.x + a.x * b.z),
          half * (a.z * b.y + a.y * b.z),
          s * a.z * b.z};
}

//! Moment M that a joint exerts on its first segment. With the rotation phi of the second segment
//! against the first one, dM / dphi = stiffness - [M]x / 2 in the frame that turns with the first.
struct JointMoment {
  Vec3 moment;           // N m
  Symmetric3 stiffness;  // N m/rad
};

//! @param flexural  E I / l
//! @param torsional  G J / l
DM_INLINE JointMoment momentOf(const Joint& joint, const Pack& flexural, const Pack& torsional) {
  const Pack torque = torsional * joint.twist;
  const Vec3 axis = joint.axis();
  const Symmetric3 bending =
      isotropic(flexural * dot(joint.d0, joint.d1)) - symmetricProduct(flexural, joint.d0, joint.d1);
  const Symmetric3 twisting = addOuter(symmetricProduct(torque * joint.lean, axis, joint.normal), torsional, axis);
  return {scaleAdd(torque, axis, flexural * joint.normal), bending + twisting};
}

//! The same of a joint with a natural shape.
DM_INLINE JointMoment momentOf(const Joint& joint, const NaturalJoint& natural, const Pack& flexural,
                               const Pack& torsional) {
  const Pack half = 0.5 * flexural;
  const Pack torque = torsional * (joint.twist - natural.twist);
  const Vec3 axis = joint.axis();
  const Vec3 moment = crossAdd(natural.c0, joint.d1, cross(joint.d0, natural.c1));
  const Pack aligned = dot(natural.c0, joint.d1) + dot(joint.d0, natural.c1);
  const Symmetric3 bending = isotropic(half * aligned) - symmetricProduct(half, natural.c0, joint.d1) -
                             symmetricProduct(half, joint.d0, natural.c1);
  const Symmetric3 twisting = addOuter(symmetricProduct(torque * joint.lean, axis, joint.normal), torsional, axis);
  return {scaleAdd(torque, axis, half * moment), bending + twisting};
}

//! The number of negative eigenvalues of a matrix, by its leading minors.
DM_INLINE Pack negativeEigenvalues(const Symmetric3& a) {
  const Pack zero = {};
  const Pack one = broadcast(1.0);
  const Pack minor = a.xx * a.yy - a.yx * a.yx;
  const Pack determinant =
      a.xx * (a.yy * a.zz - a.zy * a.zy) + a.yx * (a.zy * a.zx - a.yx * a.zz) + a.zx * (a.yx * a.zy - a.yy * a.zx);
  return (a.xx < zero ? one : zero) + (a.xx * minor < zero ? one : zero) + (minor * determinant < zero ? one : zero);
}

//! A function of each column.
template <typename Function>
DM_INLINE Matrix3 byColumns(const Matrix3& a, const Function& function) {
  return {function(a.x), function(a.y), function(a.z)};
}

DM_INLINE Symmetric3 loadSymmetric3(const double* from) {
  return {load(from),
          load(from + kLanes),
          load(from + 2 * kLanes),
          load(from + 3 * kLanes),
          load(from + 4 * kLanes),
          load(from + 5 * kLanes)};
}
DM_INLINE void storeSymmetric3(double* to, const Symmetric3& a) {
  store(to, a.xx);
  store(to + kLanes, a.yx);
  store(to + 2 * kLanes, a.yy);
  store(to + 3 * kLanes, a.zx);
  store(to + 4 * kLanes, a.zy);
  store(to + 5 * kLanes, a.zz);
}
DM_INLINE Matrix3 loadMatrix3(const double* from) {
  return {load3(from, kLanes), load3(from + 3 * kLanes, kLanes), load3(from + 6 * kLanes, kLanes)};
}
DM_INLINE void storeMatrix3(double* to, const Matrix3& a) {
  store3(to, kLanes, a.x);
  store3(to + 3 * kLanes, kLanes, a.y);
  store3(to + 6 * kLanes, kLanes, a.z);
}

// A longer Newton step is cut to this: beyond, the linearisation means nothing.
constexpr double kLongestTurn = 0.5;  // rad

//! Newton's method for the lanes of one pack.
//!
//! Unknowns are the rotations of the segments that are not clamped and the force in each span. The
//! moments on the segments couple neighbours only (3 x 3 blocks, block tridiagonal); the condition
//! that each span reaches from hold to hold borders that matrix with three columns per span.
class Equilibrium {
 public:
  Equilibrium(const RodEquilibriumInput& input, RodEquilibriumLanes& lanes, int first_lane)
      : in_(input), s_(lanes), lane_(first_lane), weight_(broadcast3(input.weight)) {}

  void step() {
    negative_ = Pack{};
    eliminate();
    substituteBack();
    close();
    apply();
  }

  //! Follows moved holds to first order, with the matrices of the last step.
  void follow() {
    const int rows = 3 * in_.span_count;
    for (int r = 0; r < rows; ++r) {
      Pack change = {};
      for (int k = 0; k < rows; ++k) {
        const Pack moved = load(at(s_.reach, k)) - load(at(s_.last_reach, k));
        change += load(closure(r, rows + 1 + k)) * moved;
      }
      store(closure(r, rows), change);
    }
    for (int i = 0; i < in_.segments; ++i) {
      store3(at(s_.correction, 3 * i), kLanes, Vec3{});
    }
    negative_ = load(at(s_.unstable, 0));
    apply();
  }

  //! Derivatives of all points with respect to each held point, from the last step.
  void respond() {
    for (int h = 1; h < in_.held_count; ++h) {
      for (int axis = 0; axis < 3; ++axis) {
        forcesFor(h, axis);
        respondTo(h, axis);
      }
    }
    respondToFirst();
  }

 private:
  DM_INLINE double* at(AlignedArray& array, int component) const { return &array[component * kLanes + lane_]; }
  DM_INLINE Quat orientation(int i) const { return load4(at(s_.orientation, 4 * i), kLanes); }
  DM_INLINE Vec3 tangent(int i) const { return load3(at(s_.tangent, 3 * i), kLanes); }
  double* forceResponse(int i, int span) const { return at(s_.force_response, 9 * (i * in_.span_count + span)); }
  int width() const { return 6 * in_.span_count + 1; }
  double* closure(int row, int column) const { return at(s_.closure, row * width() + column); }

  DM_INLINE Pack halfLength(int i) const { return broadcast(in_.half_length[i]); }

  //! Force of joint j on segment j.
  DM_INLINE Vec3 force(int j) const {
    if (j < 0 || j + 1 >= in_.segments) {
      return Vec3{};
    }
    const int span = in_.span_of_joint[j];
    const double before = in_.weights_before[j + 1];
    if (span >= 0) {
      return load3(at(s_.force, 3 * span), kLanes) -
             broadcast(before - in_.weights_before[in_.spans[span].first + 1]) * weight_;
    }
    const double hanging = j < in_.held[0] ? -before : in_.weights_before[in_.segments] - before;
    return broadcast(hanging) * weight_;
  }

  DM_INLINE NaturalJoint naturalJoint(int j, const Quat& q0, const Quat& q1) const {
    return {rotatedBy(q0, broadcast3(in_.natural_ahead + 3 * j)), rotatedBy(q1, broadcast3(in_.natural_behind + 3 * j)),
            broadcast(in_.natural_twist[j])};
  }

  //! How many joints of a span a segment has.
  int jointsIn(int span, int i) const {
    const bool before = i > 0 && in_.span_of_joint[i - 1] == span;
    const bool after = i + 1 < in_.segments && in_.span_of_joint[i] == span;
    return before + after;
  }

  //! d moment on a segment / d force in a span
  DM_INLINE Matrix3 leverOf(int span, int i, const Vec3& d) const {
    return crossMatrix((broadcast(jointsIn(span, i)) * halfLength(i)) * d);
  }

  //! Forward elimination of the moment balance, for the residual and for each force of the spans.
  void eliminate() {
    JointMoment before = {};
    Vec3 force_before = {};
    Quat q = orientation(0);
    Vec3 next_tangent = tangentOf(q);
    for (int i = 0; i < in_.segments; ++i) {
      const Vec3 d = next_tangent;
      store3(at(s_.tangent, 3 * i), kLanes, d);
      JointMoment after = {};
      if (i + 1 < in_.segments) {
        const Quat next = orientation(i + 1);
        next_tangent = tangentOf(next);
        const Joint joint = jointBetween(q, d, next, next_tangent, load(at(s_.twist, i)));
        store(at(s_.twist, i), joint.twist);
        const Pack flexural = broadcast(in_.flexural[i]);
        const Pack torsional = broadcast(in_.torsional[i]);
        after = in_.natural_ahead == nullptr ? momentOf(joint, flexural, torsional)
                                             : momentOf(joint, naturalJoint(i, q, next), flexural, torsional);
        q = next;
      }
      const Vec3 force_after = force(i);
      const Vec3 pull = scaleAdd(broadcast(in_.lean_weight[i]), weight_, force_before + force_after);
      const Vec3 residual = after.moment - before.moment + halfLength(i) * cross(d, pull);
      eliminateSegment(i, d, pull, residual, before.stiffness, after);
      before = after;
      force_before = force_after;
    }
  }

  DM_INLINE void eliminateSegment(int i, const Vec3& d, const Vec3& pull, const Vec3& residual,
                                  const Symmetric3& before, const JointMoment& after) {
    const bool free = !in_.clamped[i];
    const bool coupled = i > 0 && free && !in_.clamped[i - 1];
    Symmetric3 pivot = isotropic(broadcast(1.0));
    Vec3 right = {};
    if (free) {
      pivot = addOuter(before + after.stiffness + isotropic(halfLength(i) * dot(d, pull)),
                       broadcast(in_.spin_stiffness), d) -
              symmetricProduct(halfLength(i), d, pull);
      right = residual;
    }
    Matrix3 carried = {};  // inverse pivot of the segment before times the coupling
    if (coupled) {
      const Matrix3 coupling = loadMatrix3(at(s_.coupling, 9 * (i - 1)));
      carried = loadSymmetric3(at(s_.inverse_pivot, 6 * (i - 1))) * coupling;
      pivot = pivot - transposedTimesSymmetric(coupling, carried);
      right = right - transposedTimes(carried, load3(at(s_.correction, 3 * (i - 1)), kLanes));
    }
    negative_ += negativeEigenvalues(pivot);
    storeSymmetric3(at(s_.inverse_pivot, 6 * i), inverse(pivot));
    store3(at(s_.correction, 3 * i), kLanes, right);
    const Matrix3 turning = crossMatrix(broadcast(0.5) * after.moment);
    storeMatrix3(at(s_.coupling, 9 * i), turning - after.stiffness);
    for (int span = 0; span < in_.span_count; ++span) {
      Matrix3 lever = {};
      if (free) {
        lever = leverOf(span, i, d);
      }
      if (coupled) {
        lever = lever + byColumns(loadMatrix3(forceResponse(i - 1, span)),
                                  [&](const Vec3& v) { return -transposedTimes(carried, v); });
      }
      storeMatrix3(forceResponse(i, span), lever);
    }
  }

  void substituteBack() {
    for (int i = in_.segments - 1; i >= 0; --i) {
      const Symmetric3 inverse_pivot = loadSymmetric3(at(s_.inverse_pivot, 6 * i));
      const bool coupled = i + 1 < in_.segments && !in_.clamped[i] && !in_.clamped[i + 1];
      const Matrix3 coupling = coupled ? loadMatrix3(at(s_.coupling, 9 * i)) : Matrix3{};
      Vec3 right = load3(at(s_.correction, 3 * i), kLanes);
      if (coupled) {
        right = right - coupling * load3(at(s_.correction, 3 * (i + 1)), kLanes);
      }
      store3(at(s_.correction, 3 * i), kLanes, inverse_pivot * right);
      for (int span = 0; span < in_.span_count; ++span) {
        Matrix3 lever = loadMatrix3(forceResponse(i, span));
        if (coupled) {
          lever = lever +
                  byColumns(loadMatrix3(forceResponse(i + 1, span)), [&](const Vec3& v) { return -(coupling * v); });
        }
        storeMatrix3(forceResponse(i, span), inverse_pivot * lever);
      }
    }
  }

  //! How the reach of a span changes as segment i turns.
  DM_INLINE Vec3 reachChange(int span, int i, const Vec3& d, const Vec3& turn) const {
    const Vec3 v = cross(turn, d);
    Vec3 change = (broadcast(jointsIn(span, i)) * halfLength(i)) * v;
    if (i + 1 < in_.segments && in_.span_of_joint[i] == span) {
      change = change + gapChange(i, d, v);
    }
    return change;
  }

  //! How the axial extension of joint j changes with its first segment's tangent d by v.
  DM_INLINE Vec3 gapChange(int j, const Vec3& d, const Vec3& v) const {
    const Vec3 pull = force(j);
    return broadcast(in_.extension[j]) * (dot(v, pull) * d + dot(d, pull) * v);
  }

  //! Conditions that every span ends where it is held: matrix, right-hand side, and the inverse.
  void close() {
    const int rows = 3 * in_.span_count;
    for (int r = 0; r < rows; ++r) {
      for (int c = 0; c < width(); ++c) {
        store(closure(r, c), c == rows + 1 + r ? broadcast(1.0) : Pack{});
      }
    }
    for (int span = 0; span < in_.span_count; ++span) {
      Vec3 missing = load3(at(s_.reach, 3 * span), kLanes);
      for (int i = in_.spans[span].first; i <= in_.spans[span].last; ++i) {
        const Vec3 d = tangent(i);
        missing = missing - (broadcast(jointsIn(span, i)) * halfLength(i)) * d;
        missing = missing - reachChange(span, i, d, load3(at(s_.correction, 3 * i), kLanes));
        if (i < in_.spans[span].last) {
          const Pack axial = broadcast(in_.extension[i]);
          missing = missing - (axial * dot(d, force(i))) * d;
          addToClosure(span, span, {(axial * d.x) * d, (axial * d.y) * d, (axial * d.z) * d});
        }
        for (int other = 0; other < in_.span_count; ++other) {
          addToClosure(span, other, byColumns(loadMatrix3(forceResponse(i, other)), [&](const Vec3& turn) {
                         return reachChange(span, i, d, turn);
                       }));
        }
      }
      store(closure(3 * span, rows), missing.x);
      store(closure(3 * span + 1, rows), missing.y);
      store(closure(3 * span + 2, rows), missing.z);
    }
    eliminateClosure(rows);
  }

  DM_INLINE void addToClosure(int span, int other, const Matrix3& block) {
    const Vec3* columns[3] = {&block.x, &block.y, &block.z};
    for (int k = 0; k < 3; ++k) {
      const Pack entries[3] = {columns[k]->x, columns[k]->y, columns[k]->z};
      for (int r = 0; r < 3; ++r) {
        double* entry = closure(3 * span + r, 3 * other + k);
        store(entry, load(entry) + entries[r]);
      }
    }
  }

  //! Gauss-Jordan; the negative pivots of this Schur complement make up for those of the chain.
  void eliminateClosure(int rows) {
    const Pack zero = {};
    const Pack one = broadcast(1.0);
    for (int p = 0; p < rows; ++p) {
      const Pack pivot = load(closure(p, p));
      negative_ -= pivot < zero ? one : zero;
      const Pack inverse = 1.0 / pivot;
      for (int c = p; c < width(); ++c) {
        store(closure(p, c), inverse * load(closure(p, c)));
      }
      for (int r = 0; r < rows; ++r) {
        if (r == p) {
          continue;
        }
        const Pack factor = load(closure(r, p));
        for (int c = p; c < width(); ++c) {
          store(closure(r, c), load(closure(r, c)) - factor * load(closure(p, c)));
        }
      }
    }
  }

  //! Rotations and forces of the Newton step.
  void apply() {
    Pack longest = {};
    Pack change = {};
    for (int i = 0; i < in_.segments; ++i) {
      const Vec3 turn = load3(at(s_.correction, 3 * i), kLanes) + turnByForces(i);
      store3(at(s_.correction, 3 * i), kLanes, turn);
      const Vec3 v = cross(turn, tangent(i));
      longest = largerOf(longest, dot(turn, turn));
      change = largerOf(change, dot(v, v));
    }
    const Pack limit = broadcast(kLongestTurn);
    const Pack scale = limit / largerOf(squareRoot(longest), limit);
    for (int i = 0; i < in_.segments; ++i) {
      if (!in_.clamped[i]) {
        store4(at(s_.orientation, 4 * i), kLanes,
               rotated(orientation(i), (0.5 * scale) * load3(at(s_.correction, 3 * i), kLanes)));
      }
    }
    for (int span = 0; span < in_.span_count; ++span) {
      double* to = at(s_.force, 3 * span);
      const Vec3 before = load3(to, kLanes);
      const Vec3 by = forceChange(span);
      store3(to, kLanes, before + scale * by);
      change = largerOf(change, dot(by, by) / (dot(before, before) + broadcast(1e-300)));
    }
    store(at(s_.change, 0), squareRoot(change));
    store(at(s_.unstable, 0), negative_);
  }

  DM_INLINE Vec3 forceChange(int span) const {
    const int column = 3 * in_.span_count;
    return {load(closure(3 * span, column)), load(closure(3 * span + 1, column)), load(closure(3 * span + 2, column))};
  }

  //! Puts the change of the spans' forces for a unit displacement of a hold in place of the step's.
  void forcesFor(int h, int axis) {
    const int rows = 3 * in_.span_count;
    for (int r = 0; r < rows; ++r) {
      Pack sum = {};
      for (int span = 0; span < in_.span_count; ++span) {
        const Pack inverse = load(closure(r, rows + 1 + 3 * span + axis));
        if (in_.spans[span].last == in_.held[h]) {
          sum += inverse;
        } else if (in_.spans[span].first == in_.held[h]) {
          sum -= inverse;
        }
      }
      store(closure(r, rows), sum);
    }
  }

  //! Rotation of a segment by the change of the spans' forces.
  DM_INLINE Vec3 turnByForces(int i) const {
    Vec3 turn = {};
    for (int span = 0; span < in_.span_count; ++span) {
      turn = turn + loadMatrix3(forceResponse(i, span)) * forceChange(span);
    }
    return turn;
  }

  DM_INLINE Vec3 tangentChange(int i) const { return cross(turnByForces(i), tangent(i)); }

  //! How far the joint after segment i opens, for the change v of its tangent.
  DM_INLINE Vec3 openingChange(int i, const Vec3& v) const {
    const Vec3 d = tangent(i);
    Vec3 change = gapChange(i, d, v);
    if (in_.span_of_joint[i] >= 0) {
      change = change + (broadcast(in_.extension[i]) * dot(d, forceChange(in_.span_of_joint[i]))) * d;
    }
    return change;
  }

  DM_INLINE void storeResponse(int h, int point, int axis, const Vec3& value) {
    double* to = at(s_.response, 9 * (h * (in_.segments + 1) + point) + axis);
    store(to, value.x);
    store(to + 3 * kLanes, value.y);
    store(to + 6 * kLanes, value.z);
  }

  //! Column of the response: walks along the chain from the first hold, which stays, to both ends.
  void respondTo(int h, int axis) {
    const int start = in_.held[0];
    const Pack half = broadcast(0.5);
    const Vec3 start_change = tangentChange(start);
    Vec3 v = start_change;
    Vec3 end = halfLength(start) * v;
    for (int i = start; i + 1 < in_.segments; ++i) {
      const Vec3 opening = openingChange(i, v);
      storeResponse(h, i + 1, axis, end + half * opening);
      v = tangentChange(i + 1);
      end = end + opening + (2.0 * halfLength(i + 1)) * v;
    }
    storeResponse(h, in_.segments, axis, end);

    v = start_change;
    end = -(halfLength(start) * v);
    for (int i = start; i > 0; --i) {
      v = tangentChange(i - 1);
      const Vec3 opening = openingChange(i - 1, v);
      storeResponse(h, i, axis, end - half * opening);
      end = end - opening - (2.0 * halfLength(i - 1)) * v;
    }
    storeResponse(h, 0, axis, end);
  }

  //! Moving all holds together moves the rod as it is: the responses sum to the identity.
  void respondToFirst() {
    const int entries = 9 * (in_.segments + 1);
    for (int k = 0; k < entries; ++k) {
      Pack rest = broadcast(k % 9 % 4 == 0 ? 1.0 : 0.0);
      for (int h = 1; h < in_.held_count; ++h) {
        rest -= load(at(s_.response, h * entries + k));
      }
      store(at(s_.response, k), rest);
    }
  }

  const RodEquilibriumInput& in_;
  RodEquilibriumLanes& s_;
  const int lane_;
  const Vec3 weight_;
  Pack negative_;
};

void newtonStep(const RodEquilibriumInput& input, RodEquilibriumLanes& lanes, int copies) {
  for (int lane = 0; lane < copies; lane += kPackWidth) {
    Equilibrium(input, lanes, lane).step();
  }
}

void follow(const RodEquilibriumInput& input, RodEquilibriumLanes& lanes, int copies) {
  for (int lane = 0; lane < copies; lane += kPackWidth) {
    Equilibrium(input, lanes, lane).follow();
  }
}

void respond(const RodEquilibriumInput& input, RodEquilibriumLanes& lanes, int copies) {
  for (int lane = 0; lane < copies; lane += kPackWidth) {
    Equilibrium(input, lanes, lane).respond();
  }
}

}  // namespace

RodEquilibriumKernel rodEquilibriumKernel() { return {follow, newtonStep, respond}; }

}  // namespace DEFORMABLE_MANIPULATION_ISA
}  // namespace pbd
}  // namespace deformable_manipulation
