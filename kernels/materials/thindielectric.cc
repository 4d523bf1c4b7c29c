// A pane of glass without thickness: reflects, or lets light straight through, with the light that
// bounces between its two faces summed up (r + t r t + t r r r t + ... = 2 r / (1 + r)).
#include "kernels/export_material.h"
#include "kernels/transparent_media.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/materials/thindielectric.cc"
#include <hwy/foreach_target.h>

#include "kernels/fresnel-inl.h"
#include "kernels/shade-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

struct Thindielectric {
  F32 eta;

  Thindielectric(const float* params, const PathSettings& /*settings*/) : eta(Set(params[0])) {}

  static bool IsSpecular(const float* /*params*/) { return true; }

  HWY_INLINE BsdfValue Evaluate(const Vec3& /*wo*/, const Vec3& /*wi*/) const {
    const F32 zero = hn::Zero(D());
    return {{zero, zero, zero}, zero};
  }

  HWY_INLINE BsdfSample Sample(const Vec3& wo, F32 /*u0*/, F32 /*u1*/, F32 u2) const {
    const F32 one = Set(1.0f);
    const F32 cos_i = AbsCosTheta(wo);
    const F32 face = FresnelDielectric(cos_i, RefractedCosine(cos_i, eta), eta);
    const F32 pane = hn::Div(hn::Add(face, face), hn::Add(one, face));
    const Vec3 wi = IfThenElse(hn::Lt(u2, pane), MirrorDirection(wo), Neg(wo));
    return ScatterIf(HasSide(wo), {wi, {one, one, one}, Set(kSpecularPdf), one});
  }
};

SWELL_MATERIAL_KERNELS(Thindielectric)

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell {
namespace {
[[maybe_unused]] constexpr ParamSpec kThindielectricParams[] = {
    {"eta",
     ParamType::kFloat,
     {1.5f},
     0.1f,
     10.0f,
     "index of refraction of the pane, or the name of a medium",
     kTransparentMedia,
     std::size(kTransparentMedia)},
};
}  // namespace
}  // namespace swell

SWELL_EXPORT_MATERIAL(Thindielectric, "thindielectric", kThindielectricParams,
                      "thin pane of glass: mirrors, or lets light straight through",
                      /*reciprocal=*/true);
#endif
