// Rough mirror of the lecture: the mirror direction plus a random point on a sphere of radius
// "fuzz", normalised; directions that end below the surface are absorbed.
//
// Density: the ray t * wi meets the sphere |t wi - r| = fuzz at t = c +- s, where c = r.wi and
// s^2 = fuzz^2 - (1 - c^2). The sphere has 1 / (4 pi fuzz^2) per area, an area is t^2 / |cos| of
// its solid angle, and its normal has |cos| = s / fuzz at both roots. So
//   pdf = ((c + s)^2 + (c - s)^2) / (4 pi fuzz s) = (c^2 + s^2) / (2 pi fuzz s)
// inside the cone s^2 > 0, c > 0. At fuzz = 1 the nearer root is t = 0 and adds nothing, as it does
// in the formula (s = c): pdf = c / pi.
#include "kernels/export_material.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/materials/fuzzy_mirror.cc"
#include <hwy/foreach_target.h>

#include "kernels/sampling-inl.h"
#include "kernels/shade-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

struct FuzzyMirror {
  Rgb reflectance;
  F32 fuzz;
  bool specular;

  FuzzyMirror(const Params& params, const PathSettings& /*settings*/)
      : reflectance(BroadcastRgb(params)), fuzz(Set(params[3])), specular(IsSpecular(params)) {
    if (!specular) fuzz = hn::Max(fuzz, Set(1e-3f));  // a texture may be 0 in places
  }

  static constexpr bool kOpaque = true;
  static bool IsSpecular(const float* params) { return params[3] == 0.0f; }

  HWY_INLINE BsdfValue Evaluate(const Vec3& wo, const Vec3& wi) const {
    const F32 pdf = Density(wo, wi);
    return {Scale(pdf, reflectance), pdf};
  }

  HWY_INLINE BsdfSample Sample(const Vec3& wo, F32 u0, F32 u1, F32 /*u2*/) const {
    const Vec3 mirrored = MirrorDirection(wo);
    if (specular)
      return ScatterIf(HasSide(wo), {mirrored, reflectance, Set(kSpecularPdf), Set(1.0f)});
    const Vec3 sum = MulAdd(fuzz, UniformSphere(u0, u1), mirrored);
    const Mask usable = hn::Gt(Dot(sum, sum), Set(1e-12f));  // fuzz = 1 can cancel the direction
    const Vec3 wi = Normalize(IfThenElse(usable, sum, mirrored));
    const F32 pdf = Density(wo, wi);
    return ScatterIf(hn::Gt(pdf, hn::Zero(D())), {wi, reflectance, pdf, Set(1.0f)});
  }

 private:
  // The angle to the mirror direction comes from the chord, whose square keeps its digits in narrow
  // cones: sin^2 = chord^2 (1 - chord^2 / 4). At the rim the density grows without bound; `blur`,
  // the rounding error of s^2, bounds it, and widens the cone so that the integral stays 1.
  HWY_INLINE F32 Density(const Vec3& wo, const Vec3& wi) const {
    const F32 zero = hn::Zero(D()), one = Set(1.0f);
    const Vec3 chord = Sub(wi, MirrorDirection(wo));
    const F32 chord2 = Dot(chord, chord);
    const F32 c = hn::NegMulAdd(Set(0.5f), chord2, one);
    const F32 sin2 = hn::Mul(chord2, hn::NegMulAdd(Set(0.25f), chord2, one));
    const F32 blur = hn::Mul(Set(4e-7f), fuzz);
    const F32 rim = hn::MulSub(fuzz, fuzz, sin2);
    const Mask cone = hn::And(hn::Gt(rim, hn::Neg(blur)), hn::Gt(c, zero));
    const F32 s2 = hn::Max(rim, blur);
    const F32 s = hn::Sqrt(s2);
    const F32 pdf = hn::Div(hn::MulAdd(c, c, s2), hn::Mul(hn::Mul(Set(2.0f * kPi), fuzz), s));
    return hn::IfThenElseZero(hn::And(cone, SameHemisphere(wo, wi)), pdf);
  }
};

SWELL_MATERIAL_KERNELS(FuzzyMirror)

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell {
namespace {
[[maybe_unused]] constexpr ParamSpec kFuzzyMirrorParams[] = {
    {"reflectance",
     ParamType::kRgb,
     {1.0f, 1.0f, 1.0f},
     0.0f,
     1.0f,
     "tint of the mirror image",
     nullptr,
     0},
    {"fuzz",
     ParamType::kFloat,
     {0.3f},
     0.0f,
     1.0f,
     "radius of the sphere around the mirror direction's tip; 0 is a perfect mirror",
     nullptr,
     0},
};
}  // namespace
}  // namespace swell

SWELL_EXPORT_MATERIAL(
    FuzzyMirror, "fuzzymirror", kFuzzyMirrorParams,
    "mirror with directions spread by a random offset from a sphere; what falls below is absorbed",
    /*reciprocal=*/false);
#endif
