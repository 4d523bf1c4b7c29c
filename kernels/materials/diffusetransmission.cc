// Lambertian reflection and transmission: f = reflectance / pi on the side of wo, transmittance /
// pi on the other; the side is drawn by the larger channels of both, then the direction by cosine.
#include "kernels/export_material.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/materials/diffusetransmission.cc"
#include <hwy/foreach_target.h>

#include "kernels/sampling-inl.h"
#include "kernels/shade-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

struct Diffusetransmission {
  Rgb reflectance, transmittance;
  F32 reflect_share;  // probability of the side of wo; 0 if there is nothing to draw
  F32 transmit_share;

  Diffusetransmission(const float* params, const PathSettings& /*settings*/)
      : reflectance(Scaled(params, params[6])), transmittance(Scaled(params + 3, params[6])) {
    const F32 r = MaxComponent(reflectance), t = MaxComponent(transmittance);
    const F32 sum = hn::Add(r, t);
    const Mask any = hn::Gt(sum, hn::Zero(D()));
    reflect_share = hn::IfThenElseZero(any, hn::Div(r, sum));
    transmit_share = hn::IfThenElseZero(any, hn::Div(t, sum));
  }

  static bool IsSpecular(const float* /*params*/) { return false; }

  HWY_INLINE BsdfValue Evaluate(const Vec3& wo, const Vec3& wi) const {
    const Mask reflect = SameHemisphere(wo, wi);
    const Mask sides = hn::And(HasSide(wo), HasSide(wi));
    const F32 lambert = hn::IfThenElseZero(sides, hn::Mul(AbsCosTheta(wi), Set(kInvPi)));
    return {Scale(lambert, IfThenElse(reflect, reflectance, transmittance)),
            hn::Mul(lambert, hn::IfThenElse(reflect, reflect_share, transmit_share))};
  }

  HWY_INLINE BsdfSample Sample(const Vec3& wo, F32 u0, F32 u1, F32 u2) const {
    Vec3 wi = CosineHemisphere(u0, u1);
    const Mask reflect = hn::Lt(u2, reflect_share);
    const F32 share = hn::IfThenElse(reflect, reflect_share, transmit_share);
    const F32 pdf = hn::Mul(hn::Mul(wi.z, Set(kInvPi)), share);
    wi.z = hn::CopySign(wi.z, hn::IfThenElse(reflect, wo.z, hn::Neg(wo.z)));
    const Rgb weight =
        Scale(hn::Div(Set(1.0f), share), IfThenElse(reflect, reflectance, transmittance));
    const Mask drawn = hn::And(HasSide(wo), hn::Gt(share, hn::Zero(D())));
    return ScatterIf(drawn, {wi, weight, pdf, Set(1.0f)});
  }

 private:
  static HWY_INLINE Rgb Scaled(const float* rgb, float scale) {
    const F32 one = Set(1.0f);
    const Rgb c = Scale(Set(scale), BroadcastRgb(rgb));
    return {hn::Min(c.r, one), hn::Min(c.g, one), hn::Min(c.b, one)};
  }
};

SWELL_MATERIAL_KERNELS(Diffusetransmission)

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell {
namespace {
[[maybe_unused]] constexpr ParamSpec kDiffusetransmissionParams[] = {
    {"reflectance",
     ParamType::kRgb,
     {0.25f, 0.25f, 0.25f},
     0.0f,
     1.0f,
     "share of light scattered back",
     nullptr,
     0},
    {"transmittance",
     ParamType::kRgb,
     {0.25f, 0.25f, 0.25f},
     0.0f,
     1.0f,
     "share of light scattered through; with reflectance at most 1 to conserve energy",
     nullptr,
     0},
    {"scale", ParamType::kFloat, {1.0f}, 0.0f, 100.0f, "multiplies both, up to 1", nullptr, 0},
};
}  // namespace
}  // namespace swell

SWELL_EXPORT_MATERIAL(Diffusetransmission, "diffusetransmission", kDiffusetransmissionParams,
                      "Lambertian reflection and transmission: paper, leaves, cloth",
                      /*reciprocal=*/true);
#endif
