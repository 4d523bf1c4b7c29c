// From the cosine of incidence and the indices of refraction to the reflected share of unpolarised
// light.
#if defined(SWELL_KERNELS_FRESNEL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_FRESNEL_INL_H_
#undef SWELL_KERNELS_FRESNEL_INL_H_
#else
#define SWELL_KERNELS_FRESNEL_INL_H_
#endif

#include "kernels/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// Snell: cosine of the refracted ray; eta is the index beyond the surface over the one before it.
// 0 from the critical angle on. The form c^2 + (eta^2 - 1) keeps cos_i to the bit when eta is 1.
HWY_INLINE F32 RefractedCosine(F32 cos_i, F32 eta) {
  const F32 one = Set(1.0f);
  const F32 bend = hn::Mul(hn::Sub(eta, one), hn::Add(eta, one));
  const F32 scaled = hn::MulAdd(cos_i, cos_i, bend);  // (eta cos_t)^2
  return hn::Div(hn::Sqrt(hn::Max(scaled, hn::Zero(D()))), eta);
}

// Fresnel's equations for two transparent media, mean of both polarisations; 1 at total internal
// reflection. cos_i > 0, and cos_t from RefractedCosine.
HWY_INLINE F32 FresnelDielectric(F32 cos_i, F32 cos_t, F32 eta) {
  const F32 eta_i = hn::Mul(eta, cos_i);
  const F32 eta_t = hn::Mul(eta, cos_t);
  const F32 parallel = hn::Div(hn::Sub(eta_i, cos_t), hn::Add(eta_i, cos_t));
  const F32 perpendicular = hn::Div(hn::Sub(cos_i, eta_t), hn::Add(cos_i, eta_t));
  const F32 sum = hn::MulAdd(parallel, parallel, hn::Mul(perpendicular, perpendicular));
  return hn::IfThenElse(hn::Gt(cos_t, hn::Zero(D())), hn::Mul(Set(0.5f), sum), Set(1.0f));
}

// Schlick's approximation (1994), in the cosine on the rarer side, so that it holds from both.
HWY_INLINE F32 FresnelSchlick(F32 cos_i, F32 cos_t, F32 eta) {
  const F32 one = Set(1.0f);
  const F32 root = hn::Div(hn::Sub(eta, one), hn::Add(eta, one));
  const F32 normal = hn::Mul(root, root);
  const F32 x = hn::Sub(one, hn::IfThenElse(hn::Lt(eta, one), cos_t, cos_i));
  const F32 x2 = hn::Mul(x, x);
  const F32 x5 = hn::Mul(hn::Mul(x2, x2), x);
  const F32 reflected = hn::MulAdd(hn::Sub(one, normal), x5, normal);
  return hn::IfThenElse(hn::Gt(cos_t, hn::Zero(D())), reflected, one);
}

// Fresnel's equations for light from a medium of index 1 on a metal of index eta + i k (Born and
// Wolf, Principles of Optics, section 14.2), mean of both polarisations.
HWY_INLINE F32 FresnelConductor(F32 cos_i, F32 eta, F32 k) {
  const F32 zero = hn::Zero(D()), two = Set(2.0f);
  const F32 cos2 = hn::Mul(cos_i, cos_i);
  const F32 sin2 = hn::Sub(Set(1.0f), cos2);
  // (a + i b)^2 = (eta + i k)^2 - sin^2; a is the real part of the scaled cosine inside the metal.
  const F32 real = hn::Sub(hn::Mul(hn::Sub(eta, k), hn::Add(eta, k)), sin2);
  const F32 half_imag = hn::Mul(eta, k);
  const F32 size =
      hn::Sqrt(hn::MulAdd(real, real, hn::Mul(Set(4.0f), hn::Mul(half_imag, half_imag))));
  // a^2 = (size + real) / 2, or without the cancellation where real < 0.
  const F32 larger = hn::Mul(Set(0.5f), hn::Add(size, hn::Abs(real)));
  const F32 positive = hn::Max(larger, Set(1e-30f));
  const F32 smaller = hn::Div(hn::Mul(half_imag, half_imag), positive);
  const F32 a = hn::Sqrt(hn::IfThenElse(hn::Lt(real, zero), smaller, larger));

  const F32 two_a_cos = hn::Mul(two, hn::Mul(a, cos_i));
  const F32 sum = hn::Add(size, cos2);
  const F32 perpendicular =
      hn::Div(hn::Sub(sum, two_a_cos), hn::Max(hn::Add(sum, two_a_cos), Set(1e-30f)));
  const F32 far_sum = hn::MulAdd(cos2, size, hn::Mul(sin2, sin2));
  const F32 mixed = hn::Mul(two_a_cos, sin2);
  const F32 ratio = hn::Div(hn::Sub(far_sum, mixed), hn::Max(hn::Add(far_sum, mixed), Set(1e-30f)));
  return hn::Mul(Set(0.5f), hn::MulAdd(perpendicular, ratio, perpendicular));
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_FRESNEL_INL_H_
