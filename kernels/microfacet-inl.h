// The GGX distribution of microfacet normals: density, masking and sampling of the visible normals.
// All directions lie on the upper side: callers mirror the lower one.
#if defined(SWELL_KERNELS_MICROFACET_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_MICROFACET_INL_H_
#undef SWELL_KERNELS_MICROFACET_INL_H_
#else
#define SWELL_KERNELS_MICROFACET_INL_H_
#endif

#include "kernels/bsdf-inl.h"
#include "kernels/sampling-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// A surface is smooth if both of its roughnesses (alpha) are below this; a rougher one has at least
// this much in every direction.
inline constexpr float kLeastAlpha = 1e-3f;

// Trowbridge and Reitz 1975; notation of Heitz, "Sampling the GGX distribution of visible normals"
// (2018).
struct Microfacets {
  F32 alpha_x, alpha_y;

  // params: roughness, uroughness, vroughness (negative: as roughness), remaproughness.
  explicit HWY_INLINE Microfacets(const Params& params)
      : alpha_x(hn::Max(Alpha(params, params[1]), Set(kLeastAlpha))),
        alpha_y(hn::Max(Alpha(params, params[2]), Set(kLeastAlpha))) {}

  // The same alpha in every direction.
  explicit HWY_INLINE Microfacets(F32 alpha)
      : alpha_x(hn::Max(alpha, Set(kLeastAlpha))), alpha_y(alpha_x) {}

  HWY_INLINE Microfacets(F32 along_x, F32 along_y)
      : alpha_x(hn::Max(along_x, Set(kLeastAlpha))), alpha_y(hn::Max(along_y, Set(kLeastAlpha))) {}

  static HWY_INLINE bool IsSmooth(const float* words) {
    const Params params(words);
    const F32 larger = hn::Max(Alpha(params, params[1]), Alpha(params, params[2]));
    return hn::GetLane(larger) < kLeastAlpha;
  }

  static HWY_INLINE bool IsStretched(const float* params) {
    return !IsSmooth(params) && params[1] != params[2];
  }

  // D(m), per solid angle of m and per area.
  HWY_INLINE F32 Distribution(const Vec3& m) const {
    const F32 x = hn::Div(m.x, alpha_x), y = hn::Div(m.y, alpha_y);
    const F32 q = hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(m.z, m.z)));
    const F32 scale = hn::Mul(hn::Mul(alpha_x, alpha_y), Set(kPi));
    return hn::Div(Set(1.0f), hn::Mul(scale, hn::Mul(q, q)));
  }

  // 1 + Lambda(w): one over the visible share of the facets that face w. w.z > 0.
  HWY_INLINE F32 Masking(const Vec3& w) const {
    const F32 x = hn::Mul(alpha_x, w.x), y = hn::Mul(alpha_y, w.y);
    const F32 slope = hn::Div(hn::MulAdd(x, x, hn::Mul(y, y)), hn::Mul(w.z, w.z));
    return hn::MulAdd(Set(0.5f), hn::Sqrt(hn::Add(Set(1.0f), slope)), Set(0.5f));
  }

  // Visible normals' density without the factor wo.m: D(m) / (cos(wo) (1 + Lambda(wo))).
  HWY_INLINE F32 VisibleDensity(const Vec3& wo, const Vec3& m) const {
    return hn::Div(Distribution(m), hn::Mul(wo.z, Masking(wo)));
  }

  // G2 / G1(wo), heights of masking and shadowing correlated.
  HWY_INLINE F32 Shadowing(const Vec3& wo, const Vec3& wi) const {
    const F32 masking = Masking(wo);
    return hn::Div(masking, hn::Sub(hn::Add(masking, Masking(wi)), Set(1.0f)));
  }

  // A normal visible from wo: stretch to the hemisphere, draw from its projected disk, stretch
  // back.
  HWY_INLINE Vec3 SampleVisible(const Vec3& wo, F32 u0, F32 u1) const {
    const F32 zero = hn::Zero(D()), one = Set(1.0f);
    const Vec3 view = Normalize(Vec3{hn::Mul(alpha_x, wo.x), hn::Mul(alpha_y, wo.y), wo.z});
    const F32 flat2 = hn::MulAdd(view.x, view.x, hn::Mul(view.y, view.y));
    const Mask tilted = hn::Gt(flat2, Set(1e-20f));
    const F32 flat = hn::Sqrt(hn::IfThenElse(tilted, flat2, one));
    const Vec3 right = {hn::IfThenElse(tilted, hn::Div(hn::Neg(view.y), flat), one),
                        hn::IfThenElseZero(tilted, hn::Div(view.x, flat)), zero};
    const Vec3 up = Cross(view, right);

    const DiskPoint p = ConcentricDisk(u0, u1);
    const F32 share = hn::MulAdd(Set(0.5f), view.z, Set(0.5f));
    const F32 half_width = hn::Sqrt(hn::Max(zero, hn::NegMulAdd(p.x, p.x, one)));
    const F32 y = hn::MulAdd(share, hn::Sub(p.y, half_width), half_width);
    const F32 rest = hn::NegMulAdd(y, y, hn::NegMulAdd(p.x, p.x, one));
    const F32 height = hn::Sqrt(hn::Max(zero, rest));
    const Vec3 normal = MulAdd(p.x, right, MulAdd(y, up, Scale(height, view)));
    return Normalize(Vec3{hn::Mul(alpha_x, normal.x), hn::Mul(alpha_y, normal.y),
                          hn::Max(normal.z, Set(1e-6f))});
  }

 private:
  // pbrt-v4's meaning of its parameters: alpha is the root of a remapped roughness.
  static HWY_INLINE F32 Alpha(const Params& params, const ParamWord& own) {
    const F32 roughness = Set(own < 0.0f ? params[0] : own);
    return params[3] != 0.0f ? hn::Sqrt(roughness) : roughness;
  }
};

HWY_INLINE Vec3 FlipZ(Mask flip, const Vec3& w) {
  return {w.x, w.y, hn::IfThenElse(flip, hn::Neg(w.z), w.z)};
}
// 2 (w.m) m - w
HWY_INLINE Vec3 ReflectAbout(const Vec3& m, const Vec3& w) {
  return Normalize(MulAdd(hn::Mul(Set(2.0f), Dot(w, m)), m, Neg(w)));
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_MICROFACET_INL_H_
