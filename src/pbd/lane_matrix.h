#pragma once

// 3 x 3 matrices on packs of SIMD lanes.

#include "lane_math.h"

namespace deformable_manipulation {
namespace pbd {
namespace DEFORMABLE_MANIPULATION_ISA {

//! A general matrix, by columns.
struct Matrix3 {
  Vec3 x, y, z;
};

DM_INLINE Vec3 operator*(const Matrix3& m, const Vec3& v) { return v.x * m.x + v.y * m.y + v.z * m.z; }

//! M v + c
DM_INLINE Vec3 multiplyAdd(const Matrix3& m, const Vec3& v, const Vec3& c) {
  return scaleAdd(v.z, m.z, scaleAdd(v.y, m.y, scaleAdd(v.x, m.x, c)));
}

//! A^T v + c
DM_INLINE Vec3 transposedMultiplyAdd(const Matrix3& a, const Vec3& v, const Vec3& c) {
  return {dotAdd(a.x, v, c.x), dotAdd(a.y, v, c.y), dotAdd(a.z, v, c.z)};
}

DM_INLINE Matrix3 operator+(const Matrix3& a, const Matrix3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
//! A^T v
DM_INLINE Vec3 transposedTimes(const Matrix3& a, const Vec3& v) { return {dot(a.x, v), dot(a.y, v), dot(a.z, v)}; }

//! [v]_x, so that crossMatrix(v) * w = v x w.
DM_INLINE Matrix3 crossMatrix(const Vec3& v) {
  const Pack zero = {};
  return {{zero, v.z, -v.y}, {-v.z, zero, v.x}, {v.y, -v.x, zero}};
}

//! A symmetric matrix: its lower triangle.
struct Symmetric3 {
  Pack xx, yx, yy, zx, zy, zz;
};

DM_INLINE Symmetric3 operator+(const Symmetric3& a, const Symmetric3& b) {
  return {a.xx + b.xx, a.yx + b.yx, a.yy + b.yy, a.zx + b.zx, a.zy + b.zy, a.zz + b.zz};
}
DM_INLINE Symmetric3 operator-(const Symmetric3& a, const Symmetric3& b) {
  return {a.xx - b.xx, a.yx - b.yx, a.yy - b.yy, a.zx - b.zx, a.zy - b.zy, a.zz - b.zz};
}
DM_INLINE Symmetric3 operator*(const Pack& s, const Symmetric3& a) {
  return {s * a.xx, s * a.yx, s * a.yy, s * a.zx, s * a.zy, s * a.zz};
}
DM_INLINE Vec3 operator*(const Symmetric3& a, const Vec3& v) {
  return {a.xx * v.x + a.yx * v.y + a.zx * v.z, a.yx * v.x + a.yy * v.y + a.zy * v.z,
          a.zx * v.x + a.zy * v.y + a.zz * v.z};
}

DM_INLINE Matrix3 operator*(const Symmetric3& a, const Matrix3& m) { return {a * m.x, a * m.y, a * m.z}; }

//! M A
DM_INLINE Matrix3 operator*(const Matrix3& m, const Symmetric3& a) {
  return {m * Vec3{a.xx, a.yx, a.zx}, m * Vec3{a.yx, a.yy, a.zy}, m * Vec3{a.zx, a.zy, a.zz}};
}

DM_INLINE Matrix3 toMatrix(const Symmetric3& a) { return {{a.xx, a.yx, a.zx}, {a.yx, a.yy, a.zy}, {a.zx, a.zy, a.zz}}; }

//! A - B
DM_INLINE Matrix3 operator-(const Matrix3& a, const Symmetric3& b) {
  return {a.x - Vec3{b.xx, b.yx, b.zx}, a.y - Vec3{b.yx, b.yy, b.zy}, a.z - Vec3{b.zx, b.zy, b.zz}};
}

//! s 1
DM_INLINE Symmetric3 isotropic(const Pack& s) {
  const Pack zero = {};
  return {s, zero, s, zero, zero, s};
}

//! A + s v v^T
DM_INLINE Symmetric3 addOuter(const Symmetric3& a, const Pack& s, const Vec3& v) {
  Vec3 sv = s * v;
  return {a.xx + sv.x * v.x, a.yx + sv.y * v.x, a.yy + sv.y * v.y,
          a.zx + sv.z * v.x, a.zy + sv.z * v.y, a.zz + sv.z * v.z};
}

//! s M + C
DM_INLINE Matrix3 multiplyAdd(const Pack& s, const Matrix3& m, const Matrix3& c) {
  return {scaleAdd(s, m.x, c.x), scaleAdd(s, m.y, c.y), scaleAdd(s, m.z, c.z)};
}

//! A v + c
DM_INLINE Vec3 multiplyAdd(const Symmetric3& a, const Vec3& v, const Vec3& c) {
  return {c.x + a.xx * v.x + a.yx * v.y + a.zx * v.z, c.y + a.yx * v.x + a.yy * v.y + a.zy * v.z,
          c.z + a.zx * v.x + a.zy * v.y + a.zz * v.z};
}

//! A M + C
DM_INLINE Matrix3 multiplyAdd(const Symmetric3& a, const Matrix3& m, const Matrix3& c) {
  return {multiplyAdd(a, m.x, c.x), multiplyAdd(a, m.y, c.y), multiplyAdd(a, m.z, c.z)};
}

//! A^T B, where that is known to be symmetric.
DM_INLINE Symmetric3 transposedTimesSymmetric(const Matrix3& a, const Matrix3& b) {
  return {dot(a.x, b.x), dot(a.y, b.x), dot(a.y, b.y), dot(a.z, b.x), dot(a.z, b.y), dot(a.z, b.z)};
}

//! A^T B + C, where A^T B is known to be symmetric.
DM_INLINE Symmetric3 transposedMultiplyAdd(const Matrix3& a, const Matrix3& b, const Symmetric3& c) {
  return {dotAdd(a.x, b.x, c.xx), dotAdd(a.y, b.x, c.yx), dotAdd(a.y, b.y, c.yy),
          dotAdd(a.z, b.x, c.zx), dotAdd(a.z, b.y, c.zy), dotAdd(a.z, b.z, c.zz)};
}

//! A B^T + C, where A B^T is known to be symmetric.
DM_INLINE Symmetric3 multiplyTransposedAdd(const Matrix3& a, const Matrix3& b, const Symmetric3& c) {
  return {c.xx + a.x.x * b.x.x + a.y.x * b.y.x + a.z.x * b.z.x, c.yx + a.x.y * b.x.x + a.y.y * b.y.x + a.z.y * b.z.x,
          c.yy + a.x.y * b.x.y + a.y.y * b.y.y + a.z.y * b.z.y, c.zx + a.x.z * b.x.x + a.y.z * b.y.x + a.z.z * b.z.x,
          c.zy + a.x.z * b.x.y + a.y.z * b.y.y + a.z.z * b.z.y, c.zz + a.x.z * b.x.z + a.y.z * b.y.z + a.z.z * b.z.z};
}

//! Inverse of a positive definite matrix, by its cofactors: one division, and shorter to wait for
//! than elimination. Loses as many digits as the matrix's condition number has, 8 of 16 where it is
//! singular but for the floor compliance.
DM_INLINE Symmetric3 inverse(const Symmetric3& a) {
  const Pack xx = a.yy * a.zz - a.zy * a.zy;
  const Pack yx = a.zy * a.zx - a.yx * a.zz;
  const Pack zx = a.yx * a.zy - a.yy * a.zx;
  const Pack scale = 1.0 / (a.xx * xx + a.yx * yx + a.zx * zx);
  return scale *
         Symmetric3{xx, yx, a.xx * a.zz - a.zx * a.zx, zx, a.yx * a.zx - a.xx * a.zy, a.xx * a.yy - a.yx * a.yx};
}

//! Writes quantities one after the other. Pack by pack: compilers copy whole structures badly.
class PackWriter {
 public:
  explicit PackWriter(double* to) : to_(to) {}
  DM_INLINE void put(const Pack& value) {
    store(to_, value);
    to_ += kPackWidth;
  }
  DM_INLINE void put(const Vec3& v) {
    put(v.x);
    put(v.y);
    put(v.z);
  }
  DM_INLINE void put(const Matrix3& m) {
    put(m.x);
    put(m.y);
    put(m.z);
  }
  DM_INLINE void put(const Symmetric3& a) {
    put(a.xx);
    put(a.yx);
    put(a.yy);
    put(a.zx);
    put(a.zy);
    put(a.zz);
  }

 private:
  double* to_;
};

//! Reads what a PackWriter has written.
class PackReader {
 public:
  explicit PackReader(const double* from) : from_(from) {}
  DM_INLINE Pack getPack() {
    from_ += kPackWidth;
    return load(from_ - kPackWidth);
  }
  DM_INLINE Vec3 getVec3() {
    const Pack x = getPack(), y = getPack(), z = getPack();
    return {x, y, z};
  }
  DM_INLINE Matrix3 getMatrix3() {
    Vec3 x = getVec3(), y = getVec3(), z = getVec3();
    return {x, y, z};
  }
  DM_INLINE Symmetric3 getSymmetric3() {
    const Pack xx = getPack(), yx = getPack(), yy = getPack(), zx = getPack(), zy = getPack(), zz = getPack();
    return {xx, yx, yy, zx, zy, zz};
  }

 private:
  const double* from_;
};

}  // namespace DEFORMABLE_MANIPULATION_ISA
}  // namespace pbd
}  // namespace deformable_manipulation
