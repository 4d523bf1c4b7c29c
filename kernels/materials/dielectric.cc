// Transparent medium, smooth or rough: reflects or refracts by Snell at the surface or at a GGX
// microfacet, drawn with the Fresnel reflectance as probability. The normal's side is outside;
// "eta" is the index inside over the index outside. Light that a facet sends to the wrong side is
// lost.
#include "kernels/export_material.h"
#include "kernels/microfacet_params.h"
#include "kernels/transparent_media.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/materials/dielectric.cc"
#include <hwy/foreach_target.h>

#include "kernels/fresnel-inl.h"
#include "kernels/microfacet-inl.h"
#include "kernels/shade-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

struct Dielectric {
  F32 eta;
  Rgb reflectance;
  Rgb transmittance;
  Microfacets facets;
  bool schlick;
  bool specular;

  Dielectric(const float* params, const PathSettings& /*settings*/)
      : eta(Set(params[0])),
        reflectance(BroadcastRgb(params + 2)),
        transmittance(BroadcastRgb(params + 5)),
        facets(params + 8),
        schlick(params[1] != 0.0f),
        specular(IsSpecular(params)) {}

  // Facets between equal media do nothing, and have no half vector.
  static bool IsSpecular(const float* params) {
    return params[0] == 1.0f || Microfacets::IsSmooth(params + 8);
  }

  static bool NeedsTangent(const float* params) { return Microfacets::IsStretched(params + 8); }

  HWY_INLINE BsdfValue Evaluate(const Vec3& wo, const Vec3& wi) const {
    const F32 zero = hn::Zero(D());
    if (specular) return {{zero, zero, zero}, zero};
    const BsdfSample scattered = Scatter(wo, wi, SameHemisphere(wo, wi));
    return {Scale(scattered.pdf, scattered.weight), scattered.pdf};
  }

  HWY_INLINE BsdfSample Sample(const Vec3& wo, F32 u0, F32 u1, F32 u2) const {
    const Mask below = hn::Lt(wo.z, hn::Zero(D()));
    const Vec3 view = FlipZ(below, wo);
    const F32 eta_rel = RelativeIndex(wo);
    if (specular) return ScatterIf(HasSide(wo), SampleSmooth(view, below, eta_rel, u2));

    const Vec3 m = facets.SampleVisible(view, u0, u1);
    const F32 cos_i = hn::Max(Dot(view, m), hn::Zero(D()));
    const F32 cos_t = RefractedCosine(cos_i, eta_rel);
    const Mask reflect = hn::Lt(u2, Reflected(cos_i, cos_t, eta_rel));
    const F32 shrink = hn::Div(Set(1.0f), eta_rel);
    const F32 along = hn::MulSub(cos_i, shrink, cos_t);
    const Vec3 refracted = MulAdd(along, m, Neg(Scale(shrink, view)));
    const Vec3 reflected = ReflectAbout(m, view);
    const Vec3 wi = FlipZ(below, IfThenElse(reflect, reflected, Normalize(refracted)));
    // A facet may reflect to the far side or refract to the near one.
    const Mask kept = hn::Not(hn::Xor(reflect, SameHemisphere(wo, wi)));
    return ScatterIf(kept, Scatter(wo, wi, reflect));
  }

 private:
  // Beyond the surface over before it, as seen from wo.
  HWY_INLINE F32 RelativeIndex(const Vec3& wo) const {
    return hn::IfThenElse(hn::Gt(wo.z, hn::Zero(D())), eta, hn::Div(Set(1.0f), eta));
  }
  HWY_INLINE F32 Reflected(F32 cos_i, F32 cos_t, F32 eta_rel) const {
    return schlick ? FresnelSchlick(cos_i, cos_t, eta_rel)
                   : FresnelDielectric(cos_i, cos_t, eta_rel);
  }
  // Radiance shrinks or grows with the squared index it crosses into: a transmitted path carries
  // 1 / eta_rel^2, and eta_scale lets roulette undo it.
  HWY_INLINE F32 EtaScale(Mask reflect, F32 eta_rel) const {
    return hn::IfThenElse(reflect, Set(1.0f), hn::Mul(eta_rel, eta_rel));
  }
  HWY_INLINE Rgb Tint(Mask reflect, F32 eta_rel) const {
    const F32 shrink = hn::Div(Set(1.0f), hn::Mul(eta_rel, eta_rel));
    return IfThenElse(reflect, reflectance, Scale(shrink, transmittance));
  }

  HWY_INLINE BsdfSample SampleSmooth(const Vec3& view, Mask below, F32 eta_rel, F32 u2) const {
    const F32 cos_t = RefractedCosine(view.z, eta_rel);
    const Mask reflect = hn::Lt(u2, Reflected(view.z, cos_t, eta_rel));
    // Normalised because 1 / eta_rel magnifies the rounding of wo.
    const Vec3 refracted = Normalize(
        Vec3{hn::Neg(hn::Div(view.x, eta_rel)), hn::Neg(hn::Div(view.y, eta_rel)), hn::Neg(cos_t)});
    const Vec3 wi = FlipZ(below, IfThenElse(reflect, MirrorDirection(view), refracted));
    return {wi, Tint(reflect, eta_rel), Set(kSpecularPdf), EtaScale(reflect, eta_rel)};
  }

  // Walter et al., "Microfacet Models for Refraction" (2007): the facet is the half vector of wo
  // and eta_rel wi (eq. 16), the density of wi is that of the facet times dm / dwi (eq. 14 and 17).
  HWY_INLINE BsdfSample Scatter(const Vec3& wo, const Vec3& wi, Mask reflect) const {
    const F32 zero = hn::Zero(D()), one = Set(1.0f);
    const Mask below = hn::Lt(wo.z, zero);
    const Vec3 view = FlipZ(below, wo), light = FlipZ(below, wi);
    const F32 eta_rel = RelativeIndex(wo);
    const Vec3 sum = MulAdd(hn::IfThenElse(reflect, one, eta_rel), light, view);
    const F32 length = hn::CopySign(hn::Sqrt(Dot(sum, sum)), sum.z);
    const Vec3 m = {hn::Div(sum.x, length), hn::Div(sum.y, length), hn::Div(sum.z, length)};
    const F32 cos_i = Dot(view, m), cos_l = Dot(light, m);
    // The facet is met on the same side as the surface, by both directions.
    const Mask facing = hn::And(hn::Gt(cos_i, zero), hn::Gt(hn::Mul(cos_l, light.z), zero));

    // Refraction knows both cosines, to more digits than Snell's law gives near the critical angle.
    const F32 cos_t = hn::IfThenElse(reflect, RefractedCosine(cos_i, eta_rel), hn::Abs(cos_l));
    const F32 share = Reflected(cos_i, cos_t, eta_rel);
    const F32 visible = facets.VisibleDensity(view, m);
    const F32 reflect_pdf = hn::Mul(hn::Mul(Set(0.25f), share), visible);
    const F32 span = hn::Add(cos_l, hn::Div(cos_i, eta_rel));
    const F32 jacobian = hn::Div(hn::Abs(hn::Mul(cos_l, cos_i)), hn::Mul(span, span));
    const F32 refract_pdf = hn::Mul(hn::Mul(jacobian, hn::Sub(one, share)), visible);
    const F32 pdf = hn::IfThenElse(reflect, reflect_pdf, refract_pdf);

    const Vec3 lit = {light.x, light.y, hn::Abs(light.z)};
    const Rgb weight = Scale(facets.Shadowing(view, lit), Tint(reflect, eta_rel));
    const Mask kept =
        hn::And(hn::And(HasSide(wo), HasSide(wi)), hn::And(facing, hn::Gt(pdf, zero)));
    return ScatterIf(kept, {wi, weight, pdf, EtaScale(reflect, eta_rel)});
  }
};

SWELL_MATERIAL_KERNELS(Dielectric)

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell {
namespace {
[[maybe_unused]] constexpr NamedValue kFresnelChoices[] = {{"exact", {0.0f}}, {"schlick", {1.0f}}};

[[maybe_unused]] constexpr ParamSpec kDielectricParams[] = {
    {"eta",
     ParamType::kFloat,
     {1.5f},
     0.1f,
     10.0f,
     "index of refraction inside over that outside, or the name of a medium",
     kTransparentMedia,
     std::size(kTransparentMedia)},
    {"fresnel",
     ParamType::kChoice,
     {0.0f},
     0.0f,
     1.0f,
     "reflected share: Fresnel's equations or Schlick's approximation",
     kFresnelChoices,
     std::size(kFresnelChoices)},
    {"reflectance",
     ParamType::kRgb,
     {1.0f, 1.0f, 1.0f},
     0.0f,
     1.0f,
     "tint of reflected light",
     nullptr,
     0},
    {"transmittance",
     ParamType::kRgb,
     {1.0f, 1.0f, 1.0f},
     0.0f,
     1.0f,
     "tint of refracted light, at every crossing",
     nullptr,
     0},
    SWELL_MICROFACET_PARAMS,
};
}  // namespace
}  // namespace swell

SWELL_EXPORT_MATERIAL(
    Dielectric, "dielectric", kDielectricParams,
    "glass, smooth or rough (GGX): reflection and refraction by Fresnel and Snell",
    /*reciprocal=*/true);
#endif
