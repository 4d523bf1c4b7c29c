// Scattering by a medium: the phase function of Henyey and Greenstein, its values and samples.
#if defined(SWELL_KERNELS_PHASE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_PHASE_INL_H_
#undef SWELL_KERNELS_PHASE_INL_H_
#else
#define SWELL_KERNELS_PHASE_INL_H_
#endif

#include "kernels/sampling-inl.h"
#include "kernels/surface-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

struct PhaseDraw {
  Vec3 wi;
  F32 pdf;  // the phase function itself
};

// Per solid angle, at the cosine between the directions of travel before and after. Henyey and
// Greenstein 1941; g is the mean cosine.
HWY_INLINE F32 EvaluatePhase(F32 g, F32 cosine) {
  constexpr float kInvSphere = 0.0795774715f;  // 1 / (4 pi)
  const F32 square = hn::Mul(g, g);
  const F32 base = hn::NegMulAdd(hn::Add(g, g), cosine, hn::Add(Set(1.0f), square));
  const F32 safe = hn::Max(base, Set(1e-12f));
  const F32 top = hn::Mul(Set(kInvSphere), hn::Sub(Set(1.0f), square));
  return hn::Div(top, hn::Mul(safe, hn::Sqrt(safe)));
}

// `w` is the direction of travel before.
HWY_INLINE PhaseDraw SamplePhase(F32 g, const Vec3& w, F32 u0, F32 u1) {
  const F32 one = Set(1.0f), two_g = hn::Add(g, g);
  const F32 square = hn::Mul(g, g);
  // Inverse of the cumulative distribution; for small g to its first order, as it divides by g.
  const F32 part = hn::Div(hn::Sub(one, square), hn::MulAdd(two_g, u0, hn::Sub(one, g)));
  const F32 drawn = hn::Div(hn::NegMulAdd(part, part, hn::Add(one, square)), two_g);
  const F32 even = hn::MulSub(Set(2.0f), u0, one);
  const F32 tilt = hn::Mul(Set(1.5f), hn::NegMulAdd(even, even, one));
  const F32 nearly = hn::MulAdd(g, tilt, even);
  const Mask isotropic = hn::Lt(hn::Abs(g), Set(1e-3f));
  const F32 cosine = hn::Max(hn::Min(hn::IfThenElse(isotropic, nearly, drawn), one), hn::Neg(one));
  const F32 sine = hn::Sqrt(hn::Max(hn::Zero(D()), hn::NegMulAdd(cosine, cosine, one)));
  F32 sin_turn, cos_turn;
  SinCosTurns(u1, &sin_turn, &cos_turn);
  const Vec3 wi = ToWorld(MakeFrame(w), {hn::Mul(sine, cos_turn), hn::Mul(sine, sin_turn), cosine});
  return {wi, EvaluatePhase(g, cosine)};
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_PHASE_INL_H_
