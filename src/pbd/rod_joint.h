#pragma once

// The zero-stretch, bending-twisting constraint between two neighbouring segments of a rod
// (Deul et al. 2018), in the fixed frame. With d the tangents and l the segment length,
//
//   C = [ x0 + l/2 d0 - (x1 - l/2 d1) ;  2/l bend + 1/l twist d0 ].
//
// The rotation from one segment to the other is a turn about d0 by the twist, followed by the
// smallest one that carries d0 to d1. A circular cross-section needs no more than the tangents and
// the twist, which is why there is no material frame here. See docs/mathematics.md.

#include "lane_matrix.h"

namespace deformable_manipulation {
namespace pbd {
namespace DEFORMABLE_MANIPULATION_ISA {

// Where a joint is folded back onto itself, its twist has no axis. Within a degree of there, it keeps this much.
constexpr double kLeastLean = 1e-4;

struct Joint {
  Vec3 d0, d1;  // tangents
  Vec3 sum;     // d0 + d1
  Vec3 normal;  // d0 x d1
  Pack lean;    // 1 / (1 + d0 . d1)
  Pack twist;   // rad

  //! u: derivative of the twist by the second segment's rotation.
  DM_INLINE Vec3 axis() const { return lean * sum; }
};

//! What a joint of a rod with a natural shape has besides (natural_shape.h): the bending energy is that of the pairs
//! c0, d1 and d0, c1 in place of d0, d1, half each.
struct NaturalJoint {
  Vec3 c0;     // tangent that the second segment would have without load
  Vec3 c1;     // likewise of the first one
  Pack twist;  // rad, without load
};

// With half the twist of a smaller tangent, four terms of its series will do: 11 degrees.
constexpr double kSmallTangent = 0.1;

//! Twice the angle with a small tangent, to 2e-14 of it; coefficients by Remez' algorithm.
DM_INLINE Pack smallTwist(const Pack& tangent) {
  const Pack z = tangent * tangent;
  return tangent * (2.0 + z * (-0.66666666653767948 +
                               z * (0.39999987568528356 + z * (-0.28567701504600596 + z * 0.21780866864270274))));
}

//! The twist with this sine and cosine of its half, but for whole turns: the one nearest to what it was. A joint keeps
//! less than a turn and slips beyond: one without end would gather energy from a rod that is thrown about.
//! Out of line and for packs with much twist only: the usual substep has no time for it.
__attribute__((noinline, cold)) inline Pack countedTwist(Pack sine, Pack cosine, Pack before) {
  constexpr double kTurn = 6.28318530717958648;
  const Pack tangent = sine * reciprocal(cosine);
  const Pack twist = absolute(tangent) < kSmallTangent ? smallTwist(tangent) : 2.0 * arcTangent(sine, cosine);
  const Pack counted = twist + kTurn * nearestWhole((before - twist) * (1.0 / kTurn));
  return absolute(counted) < kTurn ? counted : twist;
}

DM_INLINE Pack twistBetween(const Quat& q0, const Quat& q1, const Pack& before) {
  constexpr double kFew = 2.0;  // rad: less than a half turn from any small twist
  const Pack cosine = dotAdd(q0.v, q1.v, q0.w * q1.w);
  const Pack sine = q0.w * q1.v.x - q0.v.x * q1.w - q0.v.y * q1.v.z + q0.v.z * q1.v.y;  // about the own axis
  const Pack tangent = sine * reciprocal(cosine);
  const bool usual = allLess(absolute(tangent), broadcast(kSmallTangent)) && allLess(absolute(before), broadcast(kFew));
  if (__builtin_expect(usual, 1)) {
    return smallTwist(tangent);
  }
  return countedTwist(sine, cosine, before);
}

DM_INLINE Joint jointBetween(const Quat& q0, const Vec3& d0, const Quat& q1, const Vec3& d1, const Pack& twist_before) {
  const Pack lean = reciprocal(largerOf(1.0 + dot(d0, d1), broadcast(kLeastLean)));
  return {d0, d1, d0 + d1, cross(d0, d1), lean, twistBetween(q0, q1, twist_before)};
}

//! How far the two segments' ends are apart: the first part of C.
DM_INLINE Vec3 gapOf(const Joint& joint, const Vec3& x0, const Vec3& x1, const Pack& half_length) {
  return scaleAdd(half_length, joint.sum, x0 - x1);
}

}  // namespace DEFORMABLE_MANIPULATION_ISA
}  // namespace pbd
}  // namespace deformable_manipulation
