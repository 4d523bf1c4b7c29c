// Directions to points of a square or a rectangle, and back.
#if defined(SWELL_KERNELS_SPHERE_MAP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_SPHERE_MAP_INL_H_
#undef SWELL_KERNELS_SPHERE_MAP_INL_H_
#else
#define SWELL_KERNELS_SPHERE_MAP_INL_H_
#endif

#include "kernels/sampling-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// Clarberg 2008, "Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD": the square folds to an
// octahedron, z up in its middle. Distance and angle of a quadrant: with u, v in [0, 1] from the
// middle, the upper half has r = u + v, and r^2 = 1 - |z|, v / r = angle / 90 degrees.
HWY_INLINE Vec3 EqualAreaToSphere(F32 u, F32 v) {
  const F32 zero = hn::Zero(D()), one = Set(1.0f), two = Set(2.0f);
  const F32 x = hn::MulSub(two, u, one), y = hn::MulSub(two, v, one);
  const F32 a = hn::Abs(x), b = hn::Abs(y);
  const F32 height = hn::Sub(one, hn::Add(a, b));  // below 0 in the lower half
  const F32 r = hn::Sub(one, hn::Abs(height));
  const Mask pole = hn::Le(r, zero);
  const F32 safe_r = hn::IfThenElse(pole, one, r);
  const F32 turns = hn::Mul(Set(0.125f), hn::Add(hn::Div(hn::Sub(b, a), safe_r), one));
  F32 sin, cos;
  SinCosTurns(hn::IfThenElseZero(hn::Not(pole), turns), &sin, &cos);
  const F32 r2 = hn::Mul(r, r);
  const F32 radius = hn::Mul(r, hn::Sqrt(hn::Max(hn::Sub(two, r2), zero)));
  const F32 z = hn::CopySign(hn::Sub(one, r2), height);
  return {hn::CopySign(hn::Mul(radius, hn::Abs(cos)), x),
          hn::CopySign(hn::Mul(radius, hn::Abs(sin)), y), z};
}

// Of a unit vector.
HWY_INLINE Vec2 SphereToEqualArea(const Vec3& w) {
  const F32 zero = hn::Zero(D()), one = Set(1.0f), half = Set(0.5f);
  const F32 x = hn::Abs(w.x), y = hn::Abs(w.y), z = hn::Abs(w.z);
  // 1 - |z| without the cancellation near the poles.
  const F32 flat2 = hn::MulAdd(x, x, hn::Mul(y, y));
  const F32 r = hn::Min(hn::Sqrt(hn::Div(flat2, hn::Add(one, z))), one);
  const F32 large = hn::Max(x, y), small = hn::Min(x, y);
  const F32 safe = hn::IfThenElse(hn::Gt(large, zero), large, one);
  const F32 quarter = hn::Mul(Set(2.0f / kPi), hn::Atan(D(), hn::Div(small, safe)));
  const F32 angle = hn::IfThenElse(hn::Lt(x, y), hn::Sub(one, quarter), quarter);
  const F32 v = hn::Mul(angle, r), u = hn::Sub(r, v);
  const Mask lower = hn::Lt(w.z, zero);
  const F32 folded_u = hn::IfThenElse(lower, hn::Sub(one, v), u);
  const F32 folded_v = hn::IfThenElse(lower, hn::Sub(one, u), v);
  return {hn::MulAdd(half, hn::CopySign(folded_u, w.x), half),
          hn::MulAdd(half, hn::CopySign(folded_v, w.y), half)};
}

// Angle of (x, y) from the x axis in turns, in [0, 1].
HWY_INLINE F32 AngleInTurns(F32 y, F32 x) {
  const F32 zero = hn::Zero(D()), one = Set(1.0f), half = Set(0.5f);
  const F32 a = hn::Abs(x), b = hn::Abs(y);
  const F32 large = hn::Max(a, b), small = hn::Min(a, b);
  const F32 safe = hn::IfThenElse(hn::Gt(large, zero), large, one);
  const F32 eighth = hn::Mul(Set(0.5f * kInvPi), hn::Atan(D(), hn::Div(small, safe)));
  const F32 quarter = hn::IfThenElse(hn::Lt(a, b), hn::Sub(Set(0.25f), eighth), eighth);
  const F32 upper = hn::IfThenElse(hn::Lt(x, zero), hn::Sub(half, quarter), quarter);
  return hn::IfThenElse(hn::Lt(y, zero), hn::Sub(one, upper), upper);
}
// Angle of a unit vector from the z axis in half turns, in [0, 1].
HWY_INLINE F32 PolarInHalfTurns(const Vec3& w) {
  const F32 flat = hn::Sqrt(hn::MulAdd(w.x, w.x, hn::Mul(w.y, w.y)));
  return hn::Mul(Set(2.0f), AngleInTurns(flat, w.z));
}
HWY_INLINE Vec2 SphereToLatLong(const Vec3& w) {
  return {AngleInTurns(w.y, w.x), PolarInHalfTurns(w)};
}

// The direction at u (in turns) with the cosine z.
HWY_INLINE Vec3 LatLongToSphere(F32 u, F32 z) {
  F32 sin, cos;
  SinCosTurns(u, &sin, &cos);
  const F32 one = Set(1.0f);
  const F32 radius = hn::Sqrt(hn::Max(hn::Mul(hn::Sub(one, z), hn::Add(one, z)), hn::Zero(D())));
  return {hn::Mul(radius, cos), hn::Mul(radius, sin), z};
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_SPHERE_MAP_INL_H_
