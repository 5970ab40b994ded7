#pragma once

// Small vector algebra on packs of SIMD lanes. A pack holds the same quantity of several copies
// of a body. This header is compiled once per instruction set, each time in a namespace of its
// own (DEFORMABLE_MANIPULATION_ISA), so that the linker never mixes code for different processors.
//
// Local structures of packs are not const anywhere in the kernel: GCC leaves const ones in memory.
// Nor are they assigned to memory as a whole, which it does in pieces; see PackWriter.

#ifndef DEFORMABLE_MANIPULATION_ISA
#define DEFORMABLE_MANIPULATION_ISA portable
#define DEFORMABLE_MANIPULATION_PACK_WIDTH 2
#endif

#ifdef __AVX2__
#include <immintrin.h>
#endif

#define DM_INLINE inline __attribute__((always_inline))

namespace deformable_manipulation {
namespace pbd {
namespace DEFORMABLE_MANIPULATION_ISA {

constexpr int kPackWidth = DEFORMABLE_MANIPULATION_PACK_WIDTH;

typedef double Pack __attribute__((vector_size(kPackWidth * sizeof(double)), may_alias));

// Subtracting zero, unlike adding it, changes no number, so that nothing is computed.
DM_INLINE Pack broadcast(double value) { return value - Pack{}; }

DM_INLINE Pack load(const double* from) { return *reinterpret_cast<const Pack*>(from); }

DM_INLINE void store(double* to, const Pack& value) { *reinterpret_cast<Pack*>(to) = value; }

DM_INLINE Pack squareRoot(const Pack& value) {
  Pack root;
  for (int i = 0; i < kPackWidth; ++i) {
    root[i] = __builtin_sqrt(value[i]);
  }
  return root;
}

//! A better estimate of 1 / sqrt(value): the relative error e becomes 5/2 e^3.
DM_INLINE Pack refinedInverseRoot(const Pack& value, const Pack& estimate) {
  const Pack error = 1.0 - value * estimate * estimate;
  return estimate + estimate * error * (0.5 + 0.375 * error);
}

//! 1 / sqrt(value), to rounding; value between 1e-37 and 1e37.
DM_INLINE Pack inverseSquareRoot(const Pack& value) {
#if defined(__AVX512F__)
  const Pack estimate = (Pack)_mm512_maskz_rsqrt14_pd(0xff, (__m512d)value);  // 14 bits, then 41
  const Pack better = refinedInverseRoot(value, estimate);
  return better;
#elif defined(__AVX2__)
  const __m128 single = _mm256_cvtpd_ps((__m256d)value);
  const Pack estimate = (Pack)_mm256_cvtps_pd(_mm_rsqrt_ps(single));  // 11 bits, then 32, then all
  const Pack better = refinedInverseRoot(value, estimate);
  return better + 0.5 * better * (1.0 - value * better * better);
#else
  return 1.0 / squareRoot(value);
#endif
}

//! 1 / value, to 3e-13 of it. For AVX-512, whose division is slow.
DM_INLINE Pack reciprocal(const Pack& value) {
#if defined(__AVX512F__)
  const Pack estimate = (Pack)_mm512_maskz_rcp14_pd(0xff, (__m512d)value);  // 14 bits, then 42
  const Pack error = 1.0 - value * estimate;
  return estimate + estimate * (error + error * error);
#else
  return 1.0 / value;
#endif
}

//! +1 where the value is not negative, -1 elsewhere.
DM_INLINE Pack signOf(const Pack& value) { return value >= Pack{} ? broadcast(1.0) : broadcast(-1.0); }

DM_INLINE Pack absolute(const Pack& value) { return value < Pack{} ? -value : value; }

DM_INLINE Pack largerOf(const Pack& a, const Pack& b) { return a > b ? a : b; }

//! Whether a < b in every lane.
DM_INLINE bool allLess(const Pack& a, const Pack& b) {
#if defined(__AVX512F__)
  return _mm512_cmp_pd_mask((__m512d)a, (__m512d)b, _CMP_LT_OQ) == 0xff;
#elif defined(__AVX2__)
  return _mm256_movemask_pd((__m256d)(a < b)) == 0xf;
#else
  bool all = true;
  for (int i = 0; i < kPackWidth; ++i) {
    all = all && a[i] < b[i];
  }
  return all;
#endif
}

//! The nearest whole number; of less than 2^51.
DM_INLINE Pack nearestWhole(const Pack& value) {
  const Pack shift = broadcast(6755399441055744.0);  // 1.5 * 2^52: no room for a fraction
  return (value + shift) - shift;
}

//! The angle whose tangent is sine / cosine, between -pi/2 and pi/2, to 2e-16 of it; 0 where both are 0.
DM_INLINE Pack arcTangent(const Pack& sine, const Pack& cosine) {
  const Pack s = absolute(sine);
  const Pack c = absolute(cosine);
  // From the nearest of 0, pi/4 and pi/2 it is at most pi/8.
  constexpr double kTangent = 0.4142135623730950488;
  const auto low = s < kTangent * c;
  const auto high = c < kTangent * s;
  const Pack up = low ? s : (high ? -c : s - c);
  const Pack along = low ? c : (high ? s : s + c);
  const Pack from = low ? Pack{} : (high ? broadcast(1.57079632679489662) : broadcast(0.785398163397448310));
  const Pack t = up / (along + 1e-300);
  const Pack z = t * t;
  const Pack z2 = z * z;
  const Pack z4 = z2 * z2;
  // (atan(t) / t - 1) / z by Remez' algorithm
  const Pack p0 = -0.33333333333261594 + 0.1999999998296903 * z;
  const Pack p1 = -0.1428571289134762 + 0.11111054985911985 * z;
  const Pack p2 = -0.09089625026085099 + 0.07674419054341258 * z;
  const Pack p3 = -0.06510834774165851 + 0.05039265073024553 * z;
  const Pack p = (p0 + p1 * z2) + z4 * ((p2 + p3 * z2) - 0.025498367884214612 * z4);
  return signOf(sine * cosine) * (from + (t + t * (z * p)));
}

struct Vec3 {
  Pack x, y, z;
};

DM_INLINE Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
DM_INLINE Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
DM_INLINE Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
DM_INLINE Vec3 operator*(const Pack& s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
DM_INLINE Pack dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
DM_INLINE Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// Products added to something: sums that grow term by term become fused multiply-adds.

//! a . b + c
DM_INLINE Pack dotAdd(const Vec3& a, const Vec3& b, const Pack& c) { return c + a.x * b.x + a.y * b.y + a.z * b.z; }

//! s a + c
DM_INLINE Vec3 scaleAdd(const Pack& s, const Vec3& a, const Vec3& c) {
  return {c.x + s * a.x, c.y + s * a.y, c.z + s * a.z};
}

//! a x b + c
DM_INLINE Vec3 crossAdd(const Vec3& a, const Vec3& b, const Vec3& c) {
  return {c.x + a.y * b.z - a.z * b.y, c.y + a.z * b.x - a.x * b.z, c.z + a.x * b.y - a.y * b.x};
}

DM_INLINE Vec3 broadcast3(const double* from) { return {broadcast(from[0]), broadcast(from[1]), broadcast(from[2])}; }

//! Quaternion, vector part first.
struct Quat {
  Vec3 v;
  Pack w;
};

DM_INLINE Quat normalized(const Quat& q) {
  const Pack square = dotAdd(q.v, q.v, q.w * q.w);
  const Pack scale = (1.0 / square) * squareRoot(square);  // at the same time
  return {scale * q.v, scale * q.w};
}

//! a times the conjugate of b: the rotation in the fixed frame that leads from b to a.
DM_INLINE Quat rotationBetween(const Quat& b, const Quat& a) {
  return {crossAdd(b.v, a.v, scaleAdd(-a.w, b.v, b.w * a.v)), dotAdd(a.v, b.v, a.w * b.w)};
}

//! q turned by twice the small rotation vector `half`, to first order and renormalised.
DM_INLINE Quat rotated(const Quat& q, const Vec3& half) {
  return normalized({crossAdd(half, q.v, scaleAdd(q.w, half, q.v)), dotAdd(-half, q.v, q.w)});
}

//! v turned by q.
DM_INLINE Vec3 rotatedBy(const Quat& q, const Vec3& v) {
  const Vec3 t = broadcast(2.0) * cross(q.v, v);
  return crossAdd(q.v, t, scaleAdd(q.w, t, v));
}

//! The x axis of the frame q in the fixed frame: a segment's tangent.
DM_INLINE Vec3 tangentOf(const Quat& q) {
  const Pack y2 = q.v.y + q.v.y;
  const Pack z2 = q.v.z + q.v.z;
  return {1.0 - y2 * q.v.y - z2 * q.v.z, y2 * q.v.x + z2 * q.w, z2 * q.v.x - y2 * q.w};
}

// Arrays of quantities: [item][component][lane]; the stride between components is kLanes.
DM_INLINE Vec3 load3(const double* from, int stride) {
  return {load(from), load(from + stride), load(from + 2 * stride)};
}
DM_INLINE void store3(double* to, int stride, const Vec3& value) {
  store(to, value.x);
  store(to + stride, value.y);
  store(to + 2 * stride, value.z);
}
DM_INLINE Quat load4(const double* from, int stride) { return {load3(from, stride), load(from + 3 * stride)}; }
DM_INLINE void store4(double* to, int stride, const Quat& value) {
  store3(to, stride, value.v);
  store(to + 3 * stride, value.w);
}

}  // namespace DEFORMABLE_MANIPULATION_ISA
}  // namespace pbd
}  // namespace deformable_manipulation
