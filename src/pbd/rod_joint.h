#pragma once

// The zero-stretch, bending-twisting constraint between two neighbouring segments of a rod
// (Deul et al. 2018), in the fixed frame. With d the tangents, l the segment length and
// dq = (k, w) the rotation from the first segment to the second,
//
//   C = [ x0 + l/2 d0 - (x1 - l/2 d1) ;  2/l k ].
//
// A circular cross-section makes the compliance of the second part isotropic but for the
// tangent, which is why no material frame is needed here. See docs/mathematics.md.

#include "lane_matrix.h"

namespace deformable_manipulation {
namespace pbd {
namespace DEFORMABLE_MANIPULATION_ISA {

//! Geometry of a joint. The sign of dq does not matter: whatever is made of it is even in it.
struct Joint {
  Vec3 d0, d1;  // tangents
  Vec3 k;       // vector part of dq
  Pack w;       // scalar part of dq

  //! l B v, where B is the derivative of the second part of C by the second segment's rotation.
  DM_INLINE Vec3 b(const Vec3& v) const { return crossAdd(v, k, w * v); }
  //! l B^T v
  DM_INLINE Vec3 bTransposed(const Vec3& v) const { return crossAdd(k, v, w * v); }
};

DM_INLINE Joint jointBetween(const Quat& q0, const Vec3& d0, const Quat& q1, const Vec3& d1) {
  Quat dq = rotationBetween(q0, q1);
  return {d0, d1, dq.v, dq.w};
}

//! How far the two segments' ends are apart: the first part of C.
DM_INLINE Vec3 gapOf(const Joint& joint, const Vec3& x0, const Vec3& x1, const Pack& half_length) {
  return scaleAdd(half_length, joint.d0 + joint.d1, x0 - x1);
}

}  // namespace DEFORMABLE_MANIPULATION_ISA
}  // namespace pbd
}  // namespace deformable_manipulation
