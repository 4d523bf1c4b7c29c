// Maps uniform numbers in [0, 1) to points: disk, sphere, cosine-weighted hemisphere, Gaussian.
#if defined(SWELL_KERNELS_SAMPLING_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_SAMPLING_INL_H_
#undef SWELL_KERNELS_SAMPLING_INL_H_
#else
#define SWELL_KERNELS_SAMPLING_INL_H_
#endif

#include <hwy/contrib/math/math-inl.h>

#include "kernels/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

inline constexpr float kPi = 3.14159265f;
inline constexpr float kInvPi = 0.318309886f;

// A drawn cosine is at least this, so that no draw lies in the surface, where its density is 0.
// Half of the smallest positive cosine that the disk gives for numbers in steps of 2^-24.
inline constexpr float kLeastCosine = 1.0f / 4096;

// sin and cos of pi/2 * r for |r| <= 1/2. Minimax polynomials of degree 7 and 6; absolute error
// below 1.2e-9 and 2.8e-8, to which rounding adds at most 1.2e-7 (tested).
HWY_INLINE void SinCosQuarterTurns(F32 r, F32* sin, F32* cos) {
  const F32 y = hn::Mul(r, r);
  F32 s = hn::MulAdd(Set(-0.0045922891f), y, Set(0.0796759030f));
  s = hn::MulAdd(s, y, Set(-0.645962938f));
  s = hn::MulAdd(s, y, Set(1.57079631f));
  *sin = hn::Mul(s, r);
  F32 c = hn::MulAdd(Set(-0.0204083526f), y, Set(0.253598644f));
  c = hn::MulAdd(c, y, Set(-1.23369701f));
  *cos = hn::MulAdd(c, y, Set(0.999999972f));
}

// sin and cos of 2 pi u for u in [0, 1]; absolute error below 2e-7.
HWY_INLINE void SinCosTurns(F32 u, F32* sin, F32* cos) {
  const F32 quarters = hn::Mul(u, Set(4.0f));
  const I32 quadrant = hn::NearestInt(quarters);
  F32 s, c;
  SinCosQuarterTurns(hn::Sub(quarters, hn::ConvertTo(D(), quadrant)), &s, &c);  // exact difference

  const U32 bits = hn::BitCast(DU(), quadrant);
  const Mask swap = ToFloatMask(hn::Ne(hn::And(bits, SetU(1)), hn::Zero(DU())));
  // sin is negative in quadrants 2 and 3, cos in 1 and 2: bit 1 of q and of q + 1.
  const U32 sin_sign = hn::ShiftLeft<30>(hn::And(bits, SetU(2)));
  const U32 cos_sign = hn::ShiftLeft<30>(hn::And(hn::Add(bits, SetU(1)), SetU(2)));
  *sin = hn::Xor(hn::IfThenElse(swap, c, s), FromBits(sin_sign));
  *cos = hn::Xor(hn::IfThenElse(swap, s, c), FromBits(cos_sign));
}

// The concentric map of the square to the unit disk (Shirley and Chiu 1997), with the cosine
// sqrt(1 - radius^2) free of cancellation.
struct DiskPoint {
  F32 x, y, height;
};
HWY_INLINE DiskPoint ConcentricDisk(F32 u0, F32 u1) {
  const F32 one = Set(1.0f);
  const F32 a = hn::MulSub(Set(2.0f), u0, one);
  const F32 b = hn::MulSub(Set(2.0f), u1, one);
  const Mask a_longer = hn::Gt(hn::Abs(a), hn::Abs(b));
  const F32 radius = hn::IfThenElse(a_longer, a, b);
  const F32 other = hn::IfThenElse(a_longer, b, a);
  const F32 divisor = hn::IfThenElse(hn::Eq(radius, hn::Zero(D())), one, radius);
  F32 s, c;  // of the angle from the longer axis, at most an eighth turn
  SinCosQuarterTurns(hn::Mul(Set(0.5f), hn::Div(other, divisor)), &s, &c);
  const F32 along = hn::Mul(radius, c);
  const F32 across = hn::Mul(radius, s);
  const F32 size = hn::Abs(radius);
  const F32 height = hn::Sqrt(hn::Mul(hn::Sub(one, size), hn::Add(one, size)));
  return {hn::IfThenElse(a_longer, along, across), hn::IfThenElse(a_longer, across, along), height};
}

// Uniform on the unit sphere (Archimedes): z = 1 - 2 u0.
HWY_INLINE Vec3 UniformSphere(F32 u0, F32 u1) {
  const F32 one = Set(1.0f);
  F32 s, c;
  SinCosTurns(u1, &s, &c);
  const F32 radius = hn::Mul(Set(2.0f), hn::Sqrt(hn::Mul(u0, hn::Sub(one, u0))));
  return {hn::Mul(radius, c), hn::Mul(radius, s), hn::NegMulAdd(Set(2.0f), u0, one)};
}

// Counter hash: an integer permutation with low bias (Wellons 2018, "lowbias32").
HWY_INLINE U32 HashBits(U32 x) {
  x = hn::Mul(hn::Xor(x, hn::ShiftRight<16>(x)), SetU(0x7FEB352Du));
  x = hn::Mul(hn::Xor(x, hn::ShiftRight<15>(x)), SetU(0x846CA68Bu));
  return hn::Xor(x, hn::ShiftRight<16>(x));
}
// The bits of three numbers make the seed of more numbers.
HWY_INLINE U32 HashSeed(F32 u0, F32 u1, F32 u2) {
  const U32 first = HashBits(hn::Add(Bits(u0), SetU(0x9E3779B9u)));
  return HashBits(hn::Add(HashBits(hn::Add(first, Bits(u1))), Bits(u2)));
}
// The upper 24 bits as a number in [0, 1).
HWY_INLINE F32 HashUniform(U32 seed, U32 counter) {
  const U32 bits = HashBits(hn::Add(seed, hn::Mul(counter, SetU(0x9E3779B9u))));
  const F32 integer = hn::ConvertTo(D(), hn::BitCast(DI(), hn::ShiftRight<8>(bits)));
  return hn::Mul(integer, Set(1.0f / 16777216));
}

// Uniform on the unit sphere: points of the cube until one lies in the ball (and not so near its
// centre that normalising it would lose digits). The first is given, the rest are hashed.
HWY_INLINE Vec3 RejectedSphere(F32 u0, F32 u1, F32 u2) {
  const F32 two = Set(2.0f), one = Set(1.0f);
  const U32 seed = HashSeed(u0, u1, u2);
  U32 counter = SetU(0);
  Vec3 point = {hn::MulSub(two, u0, one), hn::MulSub(two, u1, one), hn::MulSub(two, u2, one)};
  for (;;) {
    const F32 square = Dot(point, point);
    const Mask accepted = hn::And(hn::Le(square, one), hn::Gt(square, Set(1e-6f)));
    if (hn::AllTrue(D(), accepted)) return Normalize(point);
    Vec3 next;
    next.x = hn::MulSub(two, HashUniform(seed, hn::Add(counter, SetU(1))), one);
    next.y = hn::MulSub(two, HashUniform(seed, hn::Add(counter, SetU(2))), one);
    next.z = hn::MulSub(two, HashUniform(seed, hn::Add(counter, SetU(3))), one);
    counter = hn::Add(counter, SetU(3));
    point = IfThenElse(accepted, point, next);
  }
}

// Distance of a two-dimensional standard Gaussian from its centre (Box and Muller 1958).
HWY_INLINE F32 GaussianRadius(F32 u) {
  // Elementwise multiply-adds only, so the same bits for every width.
  const F32 log = hn::Log(D(), hn::Sub(Set(1.0f), u));
  return hn::Sqrt(hn::Max(hn::Zero(D()), hn::Mul(Set(-2.0f), log)));
}

// Uniform on the unit sphere: three Gaussian samples, normalised. Box and Muller's method makes
// them in pairs, so the third needs a fourth number, which is hashed.
HWY_INLINE Vec3 GaussianSphere(F32 u0, F32 u1, F32 u2) {
  F32 s, c, unused, c2;
  SinCosTurns(u1, &s, &c);
  SinCosTurns(HashUniform(HashSeed(u0, u1, u2), SetU(0)), &unused, &c2);
  const F32 radius = GaussianRadius(u0);
  const Vec3 point = {hn::Mul(radius, c), hn::Mul(radius, s), hn::Mul(GaussianRadius(u2), c2)};
  const F32 square = Dot(point, point);
  const Mask usable = hn::Gt(square, Set(1e-20f));
  const Vec3 up = {hn::Zero(D()), hn::Zero(D()), Set(1.0f)};
  return Normalize(IfThenElse(usable, point, up));
}

// Density cos / pi on the upper hemisphere. The cosine is at least kLeastCosine.
HWY_INLINE Vec3 CosineHemisphere(F32 u0, F32 u1) {
  const DiskPoint p = ConcentricDisk(u0, u1);
  return {p.x, p.y, hn::Max(p.height, Set(kLeastCosine))};
}

// The same density from a uniform point of the unit sphere: the direction to it from the point
// below, -z. At that very point, and where rounding leaves nothing of the sum, z stands for it.
HWY_INLINE Vec3 CosineFromSphere(const Vec3& on_sphere) {
  const Vec3 sum = {on_sphere.x, on_sphere.y, hn::Add(on_sphere.z, Set(1.0f))};
  const Mask usable = hn::Gt(Dot(sum, sum), Set(1e-12f));
  const Vec3 up = {hn::Zero(D()), hn::Zero(D()), Set(1.0f)};
  const Vec3 wi = Normalize(IfThenElse(usable, sum, up));
  return {wi.x, wi.y, hn::Max(wi.z, Set(kLeastCosine))};
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_SAMPLING_INL_H_
