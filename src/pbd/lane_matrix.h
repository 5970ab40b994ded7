#pragma once

// 3 x 3 matrices on packs of SIMD lanes; see lane_math.h.

#include "lane_math.h"

namespace deformable_manipulation {
namespace pbd {
namespace DEFORMABLE_MANIPULATION_ISA {

//! A matrix by its columns.
struct Mat3 {
  Vec3 column[3];
};

//! A symmetric matrix by its lower triangle.
struct Sym3 {
  Pack xx, yx, yy, zx, zy, zz;
};

DM_INLINE Vec3 operator*(const Mat3& a, const Vec3& v) {
  return v.x * a.column[0] + v.y * a.column[1] + v.z * a.column[2];
}
DM_INLINE Vec3 operator*(const Sym3& a, const Vec3& v) {
  return {a.xx * v.x + a.yx * v.y + a.zx * v.z, a.yx * v.x + a.yy * v.y + a.zy * v.z,
          a.zx * v.x + a.zy * v.y + a.zz * v.z};
}
DM_INLINE Vec3 transposedTimes(const Mat3& a, const Vec3& v) {
  return {dot(a.column[0], v), dot(a.column[1], v), dot(a.column[2], v)};
}

DM_INLINE Sym3 operator+(const Sym3& a, const Sym3& b) {
  return {a.xx + b.xx, a.yx + b.yx, a.yy + b.yy, a.zx + b.zx, a.zy + b.zy, a.zz + b.zz};
}
DM_INLINE Sym3 operator-(const Sym3& a, const Sym3& b) {
  return {a.xx - b.xx, a.yx - b.yx, a.yy - b.yy, a.zx - b.zx, a.zy - b.zy, a.zz - b.zz};
}

DM_INLINE Sym3 diagonal3(const Pack& s) {
  const Pack zero = {};
  return {s, zero, s, zero, zero, s};
}

//! [v]x, the matrix of the cross product with v from the left.
DM_INLINE Mat3 crossMatrix(const Vec3& v) {
  const Pack zero = {};
  return {{{zero, v.z, -v.y}, {-v.z, zero, v.x}, {v.y, -v.x, zero}}};
}

DM_INLINE Mat3 operator-(const Mat3& a, const Sym3& b) {
  return {{{a.column[0].x - b.xx, a.column[0].y - b.yx, a.column[0].z - b.zx},
           {a.column[1].x - b.yx, a.column[1].y - b.yy, a.column[1].z - b.zy},
           {a.column[2].x - b.zx, a.column[2].y - b.zy, a.column[2].z - b.zz}}};
}

//! s (a b^T + b a^T) / 2
DM_INLINE Sym3 symmetricProduct(const Pack& s, const Vec3& a, const Vec3& b) {
  const Pack half = 0.5 * s;
  return {s * a.x * b.x,
          half * (a.y * b.x + a.x * b.y),
          s * a.y * b.y,
          half * (a.z * b.x + a.x * b.z),
          half * (a.z * b.y + a.y * b.z),
          s * a.z * b.z};
}

//! A^T B for a product that is symmetric.
DM_INLINE Sym3 symmetricTransposedTimes(const Mat3& a, const Mat3& b) {
  return {dot(a.column[0], b.column[0]), dot(a.column[1], b.column[0]), dot(a.column[1], b.column[1]),
          dot(a.column[2], b.column[0]), dot(a.column[2], b.column[1]), dot(a.column[2], b.column[2])};
}

//! The inverse, and the number of negative eigenvalues of the matrix (by its leading minors).
DM_INLINE Sym3 inverse3(const Sym3& a, Pack& negative) {
  const Pack zero = {};
  const Pack one = broadcast(1.0);
  const Pack cxx = a.yy * a.zz - a.zy * a.zy;
  const Pack cyx = a.zy * a.zx - a.yx * a.zz;
  const Pack czx = a.yx * a.zy - a.yy * a.zx;
  const Pack minor = a.xx * a.yy - a.yx * a.yx;
  const Pack determinant = a.xx * cxx + a.yx * cyx + a.zx * czx;
  negative +=
      (a.xx < zero ? one : zero) + (a.xx * minor < zero ? one : zero) + (minor * determinant < zero ? one : zero);
  const Pack scale = 1.0 / determinant;
  return {
      scale * cxx,  scale * cyx, scale * (a.xx * a.zz - a.zx * a.zx), scale * czx, scale * (a.zx * a.yx - a.xx * a.zy),
      scale * minor};
}

DM_INLINE Sym3 loadSym3(const double* from, int stride) {
  return {load(from),
          load(from + stride),
          load(from + 2 * stride),
          load(from + 3 * stride),
          load(from + 4 * stride),
          load(from + 5 * stride)};
}
DM_INLINE void storeSym3(double* to, int stride, const Sym3& a) {
  const Pack* packs[6] = {&a.xx, &a.yx, &a.yy, &a.zx, &a.zy, &a.zz};
  for (int i = 0; i < 6; ++i) {
    store(to + i * stride, *packs[i]);
  }
}
DM_INLINE Mat3 loadMat3(const double* from, int stride) {
  return {{load3(from, stride), load3(from + 3 * stride, stride), load3(from + 6 * stride, stride)}};
}
DM_INLINE void storeMat3(double* to, int stride, const Mat3& a) {
  for (int i = 0; i < 3; ++i) {
    store3(to + 3 * i * stride, stride, a.column[i]);
  }
}

}  // namespace DEFORMABLE_MANIPULATION_ISA
}  // namespace pbd
}  // namespace deformable_manipulation
