#pragma once

// The zero-stretch, bending-twisting constraint between two neighbouring segments of a rod
// (Deul et al. 2018), in the fixed frame. With d the tangents, l the segment length and dq the
// rotation from the first segment to the second,
//
//   C = [ x0 + l/2 d0 - (x1 - l/2 d1) ;  2/l Im(dq) ].
//
// A circular cross-section makes the compliance of the second part isotropic but for the
// tangent, which is why no material frame is needed here. See docs/mathematics.md.

#include "lane_math.h"

namespace deformable_manipulation {
namespace pbd {
namespace DEFORMABLE_MANIPULATION_ISA {

//! Lower triangle of a symmetric 6 x 6 matrix, row by row.
struct Triangle6 {
  Pack at[21];
};

DM_INLINE constexpr int lower(int row, int column) { return row * (row + 1) / 2 + column; }

struct Vec6 {
  Pack at[6];
};

DM_INLINE Vec3 head(const Vec6& a) { return {a.at[0], a.at[1], a.at[2]}; }
DM_INLINE Vec3 tail(const Vec6& a) { return {a.at[3], a.at[4], a.at[5]}; }
DM_INLINE Vec6 join(const Vec3& a, const Vec3& b) { return {{a.x, a.y, a.z, b.x, b.y, b.z}}; }

//! Inverse mass and inertia of a segment; zero where held.
struct Inverse {
  Pack mass;
  Pack transverse;
  Pack axial;
};

//! I^-1 v for a segment with tangent d.
DM_INLINE Vec3 applyInverseInertia(const Inverse& inverse, const Vec3& d, const Vec3& v) {
  return inverse.transverse * v + ((inverse.axial - inverse.transverse) * dot(d, v)) * d;
}

//! Geometry of a joint at its present configuration.
struct Joint {
  Vec3 d0, d1;  // tangents
  Vec3 k;       // vector part of dq
  Pack w;       // scalar part of dq, not negative
  Pack inverse_length;

  //! B v, where B is the derivative of the second part of C by the second segment's rotation.
  DM_INLINE Vec3 b(const Vec3& v) const { return inverse_length * (w * v - cross(k, v)); }
  //! B^T v
  DM_INLINE Vec3 bTransposed(const Vec3& v) const { return inverse_length * (w * v + cross(k, v)); }
};

DM_INLINE Joint jointOf(const Quat& q0, const Quat& q1, const Pack& inverse_length) {
  const Quat dq = rotationBetween(q0, q1);
  const Pack sign = signOf(dq.w);
  return {tangentOf(q0), tangentOf(q1), sign * dq.v, sign * dq.w, inverse_length};
}

//! The constraint's value C.
DM_INLINE Vec6 constraintOf(const Joint& joint, const Vec3& x0, const Vec3& x1, const Pack& half_length) {
  const Vec3 gap = x0 - x1 + half_length * (joint.d0 + joint.d1);
  return join(gap, (2.0 * joint.inverse_length) * joint.k);
}

//! Adds s * a a^T to the 3 x 3 block of the triangle that begins at row and column `first`.
DM_INLINE void addOuter(Triangle6& matrix, int first, const Pack& s, const Vec3& a) {
  const Vec3 sa = s * a;
  matrix.at[lower(first, first)] += sa.x * a.x;
  matrix.at[lower(first + 1, first)] += sa.y * a.x;
  matrix.at[lower(first + 1, first + 1)] += sa.y * a.y;
  matrix.at[lower(first + 2, first)] += sa.z * a.x;
  matrix.at[lower(first + 2, first + 1)] += sa.z * a.y;
  matrix.at[lower(first + 2, first + 2)] += sa.z * a.z;
}

DM_INLINE void addDiagonal(Triangle6& matrix, int first, const Pack& s) {
  for (int i = first; i < first + 3; ++i) {
    matrix.at[lower(i, i)] += s;
  }
}

//! Compliances of a joint, divided by h^2.
struct Compliance {
  Pack bending;
  Pack torsion;
  Pack axial;
  Pack floor;
};

//! Compliance of the joint times a multiplier.
DM_INLINE Vec6 applyCompliance(const Compliance& c, const Joint& joint, const Vec6& multiplier) {
  const Vec3 force = head(multiplier);
  const Vec3 torque = tail(multiplier);
  return join(c.floor * force + (c.axial * dot(joint.d0, force)) * joint.d0,
              c.bending * torque + ((c.torsion - c.bending) * dot(joint.d0, torque)) * joint.d0);
}

//! J M^-1 J^T of one joint plus its compliance.
DM_INLINE Triangle6 jointMatrix(const Joint& joint, const Inverse& i0, const Inverse& i1, const Pack& half_length,
                                const Compliance& compliance) {
  Triangle6 matrix = {};
  const Pack c2 = half_length * half_length;
  addDiagonal(matrix, 0, i0.mass + i1.mass + c2 * (i0.transverse + i1.transverse) + compliance.floor);
  addOuter(matrix, 0, compliance.axial - c2 * i0.transverse, joint.d0);
  addOuter(matrix, 0, -c2 * i1.transverse, joint.d1);

  // Rows of rotation, columns of position: -l/2 B [e]x with e = d0 / It0 - d1 / It1.
  const Vec3 e = half_length * (i1.transverse * joint.d1 - i0.transverse * joint.d0);
  const Pack zero = {};
  const Vec3 columns[3] = {joint.b({zero, e.z, -e.y}), joint.b({-e.z, zero, e.x}), joint.b({e.y, -e.x, zero})};
  for (int column = 0; column < 3; ++column) {
    matrix.at[lower(3, column)] = columns[column].x;
    matrix.at[lower(4, column)] = columns[column].y;
    matrix.at[lower(5, column)] = columns[column].z;
  }

  const Pack transverse = (i0.transverse + i1.transverse) * joint.inverse_length * joint.inverse_length;
  addDiagonal(matrix, 3, transverse + compliance.bending);
  addOuter(matrix, 3, -transverse, joint.k);
  addOuter(matrix, 3, i0.axial - i0.transverse, joint.b(joint.d0));
  addOuter(matrix, 3, i1.axial - i1.transverse, joint.b(joint.d1));
  addOuter(matrix, 3, compliance.torsion - compliance.bending, joint.d0);
  return matrix;
}

//! Cholesky factor in place; the diagonal holds its reciprocals.
DM_INLINE void factorize(Triangle6& a) {
#pragma GCC unroll 6
  for (int j = 0; j < 6; ++j) {
    Pack diagonal = a.at[lower(j, j)];
#pragma GCC unroll 6
    for (int k = 0; k < j; ++k) {
      diagonal -= a.at[lower(j, k)] * a.at[lower(j, k)];
    }
    const Pack reciprocal = 1.0 / squareRoot(diagonal);
    a.at[lower(j, j)] = reciprocal;
#pragma GCC unroll 6
    for (int i = j + 1; i < 6; ++i) {
      Pack value = a.at[lower(i, j)];
#pragma GCC unroll 6
      for (int k = 0; k < j; ++k) {
        value -= a.at[lower(i, k)] * a.at[lower(j, k)];
      }
      a.at[lower(i, j)] = value * reciprocal;
    }
  }
}

//! Solves L y = b in place.
DM_INLINE void solveLower(const Triangle6& l, Vec6& b) {
#pragma GCC unroll 6
  for (int i = 0; i < 6; ++i) {
#pragma GCC unroll 6
    for (int k = 0; k < i; ++k) {
      b.at[i] -= l.at[lower(i, k)] * b.at[k];
    }
    b.at[i] *= l.at[lower(i, i)];
  }
}

//! Solves L^T y = b in place.
DM_INLINE void solveUpper(const Triangle6& l, Vec6& b) {
#pragma GCC unroll 6
  for (int i = 5; i >= 0; --i) {
#pragma GCC unroll 6
    for (int k = i + 1; k < 6; ++k) {
      b.at[i] -= l.at[lower(k, i)] * b.at[k];
    }
    b.at[i] *= l.at[lower(i, i)];
  }
}

}  // namespace DEFORMABLE_MANIPULATION_ISA
}  // namespace pbd
}  // namespace deformable_manipulation
