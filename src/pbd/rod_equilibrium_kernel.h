#pragma once

#include "rod_kernel.h"

namespace deformable_manipulation {
namespace pbd {

//! The piece of a rod between two neighbouring holds.
struct RodSpan {
  int first;  //!< held segment at its beginning
  int last;   //!< held segment at its end
};

//! What a Newton step needs besides the shapes.
struct RodEquilibriumInput {
  int segments;
  const double* half_length;     // [N] m
  const double* flexural;        // [N - 1] E I / l [N m/rad], with the length l of the rod that bends in a joint
  const double* torsional;       // [N - 1] G J / l [N m/rad]
  const double* extension;       // [N - 1] l / (E A) [m/N]
  double weight[3];              // of a usual segment alone [N]
  const double* weights_before;  // [N + 1] weights of the segments before one over that of a usual one alone, sum
  const double* lean_weight;     // [N] moment of the weight off a segment's centre, per half length and `weight`
  const double* natural_ahead;   // [(N - 1) x 3] see NaturalJoints; null: straight by nature
  const double* natural_behind;  // [(N - 1) x 3]
  const double* natural_twist;   // [N - 1] rad
  double spin_stiffness;         // N m/rad, holds the rotation about the own axis where nothing else does
  const unsigned char* clamped;  // [N]
  const int* span_of_joint;      // [N - 1], -1 in a free end
  const RodSpan* spans;          // [S] from the first to the last hold
  int span_count;                // S
  const int* held;               // [H] segments, ascending
  int held_count;                // H
};

//! Shapes of eight copies of a rod, and what Newton's method keeps of its last step.
//! Layout: [item][component][lane].
struct RodEquilibriumLanes {
  RodEquilibriumLanes(int segments, int spans, int holds);

  AlignedArray orientation;  // [N x 4] quaternion x y z w
  AlignedArray twist;        // [N - 1] rad, of each joint, up to a turn
  AlignedArray force;        // [S x 3] N, of the first joint of a span on the span's first segment
  AlignedArray reach;        // [S x 3] m, from the first to the last held centre of a span
  AlignedArray last_reach;   // [S x 3] m, of the shape found last
  AlignedArray response;     // [H x (N + 1) x 9] d point / d held point, row-major

  AlignedArray change;    // [1] of the last step: largest turn of a tangent [rad] or relative change of a force
  AlignedArray unstable;  // [1] number of directions in which the energy falls; 0: a stable shape

  AlignedArray tangent;         // [N x 3]
  AlignedArray inverse_pivot;   // [N x 6] lower triangle
  AlignedArray coupling;        // [N x 9] block between a segment and the next, columns
  AlignedArray correction;      // [N x 3] rotations [rad] without a change of the forces
  AlignedArray force_response;  // [N x S x 9] rotations per force [rad/N], columns
  AlignedArray closure;         // [3 S x (6 S + 1)] closure conditions, eliminated
};

//! For the first `copies` lanes (and those of their packs).
using RodEquilibriumFunction = void (*)(const RodEquilibriumInput&, RodEquilibriumLanes&, int copies);

//! Compiled for one instruction set.
struct RodEquilibriumKernel {
  RodEquilibriumFunction follow;   //!< turns the shapes to first order for holds that have moved since the last step
  RodEquilibriumFunction step;     //!< a step of Newton's method
  RodEquilibriumFunction respond;  //!< the derivatives, from the matrices of the last step
};

namespace portable {
RodEquilibriumKernel rodEquilibriumKernel();
}
namespace avx2 {
RodEquilibriumKernel rodEquilibriumKernel();
}
namespace avx512 {
RodEquilibriumKernel rodEquilibriumKernel();
}

//! The one that goes with selectedRodKernel().
RodEquilibriumKernel selectedRodEquilibriumKernel();

}  // namespace pbd
}  // namespace deformable_manipulation
