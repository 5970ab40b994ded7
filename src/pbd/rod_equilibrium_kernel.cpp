// Compiled once per instruction set; see lane_math.h.

#include "rod_equilibrium_kernel.h"

#include "lane_matrix.h"
#include "rod_joint.h"

namespace deformable_manipulation {
namespace pbd {
namespace DEFORMABLE_MANIPULATION_ISA {
namespace {

//! Moment that a joint exerts on its first segment, and its derivative.
struct JointMoment {
  Vec3 moment;     // N m
  Mat3 stiffness;  // d moment / d (rotation of the second against the first segment)
};

DM_INLINE JointMoment momentOf(const Joint& joint, const Pack& bending, const Pack& torsion) {
  const Pack two = 2.0 * joint.inverse_length;
  const Pack half = broadcast(0.5);
  const auto stress = [&](const Vec3& k) { return bending * k + ((torsion - bending) * dot(joint.d0, k)) * joint.d0; };
  const Vec3 s = stress(joint.k);
  JointMoment result;
  result.moment = two * (joint.w * s + cross(joint.k, s));
  const Pack zero = {};
  const Pack one = broadcast(1.0);
  const Vec3 unit[3] = {{one, zero, zero}, {zero, one, zero}, {zero, zero, one}};
  for (int i = 0; i < 3; ++i) {
    const Vec3 dk = half * (joint.w * unit[i] - cross(joint.k, unit[i]));
    const Pack dw = -half * dot(joint.k, unit[i]);
    const Vec3 ds = stress(dk);
    result.stiffness.column[i] = two * (dw * s + joint.w * ds + cross(dk, s) + cross(joint.k, ds));
  }
  return result;
}

DM_INLINE Pack largerOf(const Pack& a, const Pack& b) { return a > b ? a : b; }

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
      : in_(input),
        s_(lanes),
        lane_(first_lane),
        half_length_(broadcast(0.5 * input.segment_length)),
        inverse_length_(broadcast(1.0 / input.segment_length)),
        axial_(broadcast(input.axial_compliance)),
        weight_(broadcast3(input.weight)) {}

  void step() {
    negative_ = Pack{};
    eliminate();
    substituteBack();
    close();
    apply();
  }

  //! Derivatives of all points with respect to each held point, from the last step.
  void respond() {
    for (int h = 0; h < in_.held_count; ++h) {
      for (int axis = 0; axis < 3; ++axis) {
        forcesFor(h, axis);
        respondTo(h, axis);
      }
    }
  }

 private:
  DM_INLINE double* at(AlignedArray& array, int component) const { return &array[component * kLanes + lane_]; }
  DM_INLINE Quat orientation(int i) const { return load4(at(s_.orientation, 4 * i), kLanes); }
  DM_INLINE Vec3 tangent(int i) const { return load3(at(s_.tangent, 3 * i), kLanes); }
  double* forceResponse(int i, int span) const { return at(s_.force_response, 9 * (i * in_.span_count + span)); }
  int width() const { return 6 * in_.span_count + 1; }
  double* closure(int row, int column) const { return at(s_.closure, row * width() + column); }

  //! Force of joint j on segment j.
  DM_INLINE Vec3 force(int j) const {
    if (j < 0 || j + 1 >= in_.segments) {
      return Vec3{};
    }
    const int span = in_.span_of_joint[j];
    if (span >= 0) {
      return load3(at(s_.force, 3 * span), kLanes) - broadcast(j - in_.spans[span].first) * weight_;
    }
    const int hanging = j < in_.held[0] ? -(j + 1) : in_.segments - 1 - j;
    return broadcast(hanging) * weight_;
  }

  //! How many joints of a span a segment has.
  int jointsIn(int span, int i) const {
    const bool before = i > 0 && in_.span_of_joint[i - 1] == span;
    const bool after = i + 1 < in_.segments && in_.span_of_joint[i] == span;
    return before + after;
  }

  DM_INLINE Mat3 leverOf(int span, int i, const Vec3& d) const {
    const Pack lever = broadcast(jointsIn(span, i)) * half_length_;
    const Pack zero = {};
    return {{{zero, lever * d.z, -lever * d.y}, {-lever * d.z, zero, lever * d.x}, {lever * d.y, -lever * d.x, zero}}};
  }

  //! Forward elimination of the moment balance, for the residual and for each force of the spans.
  void eliminate() {
    const Pack bending = broadcast(in_.bending_stiffness);
    const Pack torsion = broadcast(in_.torsion_stiffness);
    JointMoment before = {};
    Vec3 force_before = {};
    Quat q = orientation(0);
    for (int i = 0; i < in_.segments; ++i) {
      const Vec3 d = tangentOf(q);
      store3(at(s_.tangent, 3 * i), kLanes, d);
      JointMoment after = {};
      if (i + 1 < in_.segments) {
        const Quat next = orientation(i + 1);
        after = momentOf(jointOf(q, next, inverse_length_), bending, torsion);
        q = next;
      }
      const Vec3 force_after = force(i);
      const Vec3 pull = force_before + force_after;
      const Vec3 residual = after.moment - before.moment + half_length_ * cross(d, pull);
      eliminateSegment(i, d, pull, residual, before.stiffness, after.stiffness);
      before = after;
      force_before = force_after;
    }
  }

  DM_INLINE void eliminateSegment(int i, const Vec3& d, const Vec3& pull, const Vec3& residual, const Mat3& before,
                                  const Mat3& after) {
    const bool free = !in_.clamped[i];
    const bool coupled = i > 0 && free && !in_.clamped[i - 1];
    Sym3 pivot = identity3();
    Vec3 right = {};
    if (free) {
      const Pack tension = half_length_ * dot(d, pull);
      const Sym3 geometric = symmetricProduct(half_length_, d, pull);
      pivot = symmetricPart(before) + symmetricPart(after) - geometric +
              symmetricProduct(broadcast(in_.spin_stiffness), d, d);
      pivot.xx += tension;
      pivot.yy += tension;
      pivot.zz += tension;
      right = residual;
    }
    Mat3 carried = {};  // inverse pivot of the segment before times the coupling
    Mat3 coupling = {};
    if (coupled) {
      coupling = loadMat3(at(s_.coupling, 9 * (i - 1)), kLanes);
      const Sym3 inverse = loadSym3(at(s_.inverse_pivot, 6 * (i - 1)), kLanes);
      for (int k = 0; k < 3; ++k) {
        carried.column[k] = inverse * coupling.column[k];
      }
      pivot = pivot - symmetricTransposedTimes(coupling, carried);
      right = right - transposedTimes(carried, load3(at(s_.correction, 3 * (i - 1)), kLanes));
    }
    storeSym3(at(s_.inverse_pivot, 6 * i), kLanes, inverse3(pivot, negative_));
    store3(at(s_.correction, 3 * i), kLanes, right);
    const Pack minus = broadcast(-1.0);
    storeMat3(at(s_.coupling, 9 * i), kLanes,
              {{minus * after.column[0], minus * after.column[1], minus * after.column[2]}});
    for (int span = 0; span < in_.span_count; ++span) {
      Mat3 lever = {};
      if (free) {
        lever = leverOf(span, i, d);
      }
      if (coupled) {
        const Mat3 previous = loadMat3(forceResponse(i - 1, span), kLanes);
        for (int k = 0; k < 3; ++k) {
          lever.column[k] = lever.column[k] - transposedTimes(carried, previous.column[k]);
        }
      }
      storeMat3(forceResponse(i, span), kLanes, lever);
    }
  }

  void substituteBack() {
    for (int i = in_.segments - 1; i >= 0; --i) {
      const Sym3 inverse = loadSym3(at(s_.inverse_pivot, 6 * i), kLanes);
      const bool coupled = i + 1 < in_.segments && !in_.clamped[i] && !in_.clamped[i + 1];
      const Mat3 coupling = coupled ? loadMat3(at(s_.coupling, 9 * i), kLanes) : Mat3{};
      const auto solve = [&](double* own, const double* next) {
        Vec3 right = load3(own, kLanes);
        if (coupled) {
          right = right - coupling * load3(next, kLanes);
        }
        store3(own, kLanes, inverse * right);
      };
      solve(at(s_.correction, 3 * i), coupled ? at(s_.correction, 3 * (i + 1)) : nullptr);
      for (int span = 0; span < in_.span_count; ++span) {
        double* next = coupled ? forceResponse(i + 1, span) : nullptr;
        for (int k = 0; k < 3; ++k) {
          const int offset = 3 * k * kLanes;
          solve(forceResponse(i, span) + offset, coupled ? next + offset : nullptr);
        }
      }
    }
  }

  //! How the reach of a span changes as segment i turns.
  DM_INLINE Vec3 reachChange(int span, int i, const Vec3& d, const Vec3& turn) const {
    const Vec3 v = cross(turn, d);
    Vec3 change = (broadcast(jointsIn(span, i)) * half_length_) * v;
    if (i + 1 < in_.segments && in_.span_of_joint[i] == span) {
      change = change + gapChange(d, v, force(i));
    }
    return change;
  }

  //! How the axial extension of a joint changes with its first segment's tangent d by v.
  DM_INLINE Vec3 gapChange(const Vec3& d, const Vec3& v, const Vec3& pull) const {
    return axial_ * (dot(v, pull) * d + dot(d, pull) * v);
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
        missing = missing - (broadcast(jointsIn(span, i)) * half_length_) * d;
        missing = missing - reachChange(span, i, d, load3(at(s_.correction, 3 * i), kLanes));
        if (i < in_.spans[span].last) {
          missing = missing - (axial_ * dot(d, force(i))) * d;
          addToClosure(span, span, {{axial_ * d.x * d, axial_ * d.y * d, axial_ * d.z * d}});
        }
        for (int other = 0; other < in_.span_count; ++other) {
          const Mat3 turns = loadMat3(forceResponse(i, other), kLanes);
          Mat3 changes;
          for (int k = 0; k < 3; ++k) {
            changes.column[k] = reachChange(span, i, d, turns.column[k]);
          }
          addToClosure(span, other, changes);
        }
      }
      store(closure(3 * span, rows), missing.x);
      store(closure(3 * span + 1, rows), missing.y);
      store(closure(3 * span + 2, rows), missing.z);
    }
    eliminateClosure(rows);
  }

  DM_INLINE void addToClosure(int span, int other, const Mat3& block) {
    for (int k = 0; k < 3; ++k) {
      const Pack* entries[3] = {&block.column[k].x, &block.column[k].y, &block.column[k].z};
      for (int r = 0; r < 3; ++r) {
        double* entry = closure(3 * span + r, 3 * other + k);
        store(entry, load(entry) + *entries[r]);
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
               rotated(orientation(i), scale * load3(at(s_.correction, 3 * i), kLanes)));
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
      turn = turn + loadMat3(forceResponse(i, span), kLanes) * forceChange(span);
    }
    return turn;
  }

  DM_INLINE Vec3 tangentChange(int i) const { return cross(turnByForces(i), tangent(i)); }

  //! How far the joint after segment i opens, for the change v of its tangent.
  DM_INLINE Vec3 openingChange(int i, const Vec3& v) const {
    const Vec3 d = tangent(i);
    Vec3 change = gapChange(d, v, force(i));
    if (in_.span_of_joint[i] >= 0) {
      change = change + (axial_ * dot(d, forceChange(in_.span_of_joint[i]))) * d;
    }
    return change;
  }

  DM_INLINE void storeResponse(int h, int point, int axis, const Vec3& value) {
    double* to = at(s_.response, 9 * (h * (in_.segments + 1) + point) + axis);
    store(to, value.x);
    store(to + 3 * kLanes, value.y);
    store(to + 6 * kLanes, value.z);
  }

  //! Column of the response: walks along the chain from the first hold to both ends.
  void respondTo(int h, int axis) {
    const int start = in_.held[0];
    const Pack one = broadcast(h == 0 ? 1.0 : 0.0);
    const Pack zero = {};
    const Vec3 held = {axis == 0 ? one : zero, axis == 1 ? one : zero, axis == 2 ? one : zero};

    const Pack half = broadcast(0.5);
    const Vec3 start_change = tangentChange(start);
    Vec3 centre = held;
    Vec3 v = start_change;
    for (int i = start; i + 1 < in_.segments; ++i) {
      const Vec3 opening = openingChange(i, v);
      const Vec3 end = centre + half_length_ * v;
      storeResponse(h, i + 1, axis, end + half * opening);
      v = tangentChange(i + 1);
      centre = end + opening + half_length_ * v;
    }
    storeResponse(h, in_.segments, axis, centre + half_length_ * v);

    centre = held;
    v = start_change;
    for (int i = start; i > 0; --i) {
      const Vec3 end = centre - half_length_ * v;
      v = tangentChange(i - 1);
      const Vec3 opening = openingChange(i - 1, v);
      storeResponse(h, i, axis, end - half * opening);
      centre = end - opening - half_length_ * v;
    }
    storeResponse(h, 0, axis, centre - half_length_ * v);
  }

  const RodEquilibriumInput& in_;
  RodEquilibriumLanes& s_;
  const int lane_;
  const Pack half_length_;
  const Pack inverse_length_;
  const Pack axial_;
  const Vec3 weight_;
  Pack negative_;
};

void newtonStep(const RodEquilibriumInput& input, RodEquilibriumLanes& lanes, int copies) {
  for (int lane = 0; lane < copies; lane += kPackWidth) {
    Equilibrium(input, lanes, lane).step();
  }
}

void respond(const RodEquilibriumInput& input, RodEquilibriumLanes& lanes, int copies) {
  for (int lane = 0; lane < copies; lane += kPackWidth) {
    Equilibrium(input, lanes, lane).respond();
  }
}

}  // namespace

RodEquilibriumKernel rodEquilibriumKernel() { return {newtonStep, respond}; }

}  // namespace DEFORMABLE_MANIPULATION_ISA
}  // namespace pbd
}  // namespace deformable_manipulation
