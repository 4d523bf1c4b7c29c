// Smooth transparent medium: reflects or refracts by Snell, drawn with the Fresnel reflectance as
// probability. The normal's side is outside; "eta" is the index inside over the index outside.
#include "kernels/export_material.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/materials/dielectric.cc"
#include <hwy/foreach_target.h>

#include "kernels/fresnel-inl.h"
#include "kernels/shade-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

struct Dielectric {
  F32 eta;
  Rgb reflectance;
  Rgb transmittance;
  bool schlick;

  Dielectric(const float* params, const PathSettings& /*settings*/)
      : eta(Set(params[0])),
        reflectance(BroadcastRgb(params + 2)),
        transmittance(BroadcastRgb(params + 5)),
        schlick(params[1] != 0.0f) {}

  static bool IsSpecular(const float* /*params*/) { return true; }

  HWY_INLINE BsdfValue Evaluate(const Vec3& /*wo*/, const Vec3& /*wi*/) const {
    const F32 zero = hn::Zero(D());
    return {{zero, zero, zero}, zero};
  }

  // Radiance shrinks or grows with the squared index it crosses into: a transmitted path carries
  // 1 / eta_rel^2, and eta_scale lets roulette undo it.
  HWY_INLINE BsdfSample Sample(const Vec3& wo, F32 /*u0*/, F32 /*u1*/, F32 u2) const {
    const F32 one = Set(1.0f);
    const Mask outside = hn::Gt(wo.z, hn::Zero(D()));
    const F32 eta_rel = hn::IfThenElse(outside, eta, hn::Div(one, eta));
    const F32 cos_i = AbsCosTheta(wo);
    const F32 cos_t = RefractedCosine(cos_i, eta_rel);
    const F32 reflected =
        schlick ? FresnelSchlick(cos_i, cos_t, eta_rel) : FresnelDielectric(cos_i, cos_t, eta_rel);
    const Mask reflect = hn::Lt(u2, reflected);

    const F32 eta2 = hn::Mul(eta_rel, eta_rel);
    // Normalised because 1 / eta_rel magnifies the rounding of wo.
    const Vec3 refracted =
        Normalize(Vec3{hn::Neg(hn::Div(wo.x, eta_rel)), hn::Neg(hn::Div(wo.y, eta_rel)),
                       hn::CopySign(cos_t, hn::Neg(wo.z))});
    const Rgb transmitted = Scale(hn::Div(one, eta2), transmittance);
    return ScatterIf(HasSide(wo), {IfThenElse(reflect, MirrorDirection(wo), refracted),
                                   IfThenElse(reflect, reflectance, transmitted), one,
                                   hn::IfThenElse(reflect, one, eta2)});
  }
};

SWELL_MATERIAL_KERNELS(Dielectric)

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell {
namespace {
// At 587.6 nm. Air at 0 C; glasses: Schott's data sheets (n_d).
[[maybe_unused]] constexpr NamedValue kIndices[] = {
    {"vacuum", {1.0f}},          {"air", {1.00029f}},         {"ice", {1.31f}},
    {"water", {1.333f}},         {"crown-glass", {1.52f}},    {"diamond", {2.417f}},
    {"glass-BK7", {1.5168f}},    {"glass-BAF10", {1.67003f}}, {"glass-FK51A", {1.48656f}},
    {"glass-LASF9", {1.85025f}}, {"glass-SF5", {1.6727f}},    {"glass-SF10", {1.72825f}},
    {"glass-SF11", {1.78472f}},
};
[[maybe_unused]] constexpr NamedValue kFresnelChoices[] = {{"exact", {0.0f}}, {"schlick", {1.0f}}};

[[maybe_unused]] constexpr ParamSpec kDielectricParams[] = {
    {"eta",
     ParamType::kFloat,
     {1.5f},
     0.05f,
     20.0f,
     "index of refraction inside over that outside, or the name of a medium",
     kIndices,
     std::size(kIndices)},
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
};
}  // namespace
}  // namespace swell

SWELL_EXPORT_MATERIAL(
    Dielectric, "dielectric", kDielectricParams,
    "smooth glass: reflection and refraction by Fresnel and Snell, total internal reflection",
    /*reciprocal=*/true);
#endif
