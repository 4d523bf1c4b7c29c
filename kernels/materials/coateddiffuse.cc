// Diffuse ground under a layer with a smooth or rough dielectric border: plastic, varnish, lacquer.
#include "kernels/export_material.h"
#include "kernels/layer_params.h"
#include "kernels/microfacet_params.h"
#include "kernels/transparent_media.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/materials/coateddiffuse.cc"
#include <hwy/foreach_target.h>

#include "kernels/layered-inl.h"
#include "kernels/shade-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// Lambertian, seen from above only.
struct DiffuseGround {
  Rgb reflectance;
  static constexpr bool specular = false;

  HWY_INLINE BsdfValue Evaluate(const Vec3& /*wo*/, const Vec3& wi) const {
    const F32 pdf = hn::Mul(hn::Max(wi.z, hn::Zero(D())), Set(kInvPi));
    return {Scale(pdf, reflectance), pdf};
  }
  HWY_INLINE BsdfSample Sample(const Vec3& /*wo*/, F32 u0, F32 u1, F32 /*u2*/) const {
    const Vec3 wi = CosineHemisphere(u0, u1);
    return {wi, reflectance, hn::Mul(wi.z, Set(kInvPi)), Set(1.0f)};
  }
  HWY_INLINE F32 Proxy(const Coat& /*coat*/, const Vec3& /*wo*/, const Vec3& wi) const {
    return hn::Mul(wi.z, Set(kInvPi));
  }
};

struct Coateddiffuse {
  Layered<DiffuseGround> layered;

  Coateddiffuse(const Params& params, const PathSettings& /*settings*/)
      : layered{{Set(params[7]), Microfacets(params + 3), Microfacets::IsSmooth(params + 3)},
                {BroadcastRgb(params)},
                Layer(params + 8)} {}

  static constexpr bool kOpaque = true;
  static bool IsSpecular(const float* /*params*/) { return false; }
  static bool NeedsTangent(const float* params) { return Microfacets::IsStretched(params + 3); }

  HWY_INLINE BsdfValue Evaluate(const Vec3& wo, const Vec3& wi, U32 seed) const {
    return layered.Evaluate(wo, wi, seed);
  }
  HWY_INLINE BsdfSample Sample(const Vec3& wo, F32 u0, F32 u1, F32 u2, U32 seed) const {
    return layered.Sample(wo, u0, u1, u2, seed);
  }
};

SWELL_MATERIAL_KERNELS(Coateddiffuse)

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell {
namespace {
[[maybe_unused]] constexpr ParamSpec kCoateddiffuseParams[] = {
    {"reflectance",
     ParamType::kRgb,
     {0.5f, 0.5f, 0.5f},
     0.0f,
     1.0f,
     "albedo of the ground, without the coat",
     nullptr,
     0},
    SWELL_MICROFACET_PARAMS,
    {"eta",
     ParamType::kFloat,
     {1.5f},
     0.1f,
     10.0f,
     "index of refraction of the layer, or the name of a medium",
     kTransparentMedia,
     std::size(kTransparentMedia)},
    SWELL_LAYER_PARAMS,
};
}  // namespace
}  // namespace swell

SWELL_EXPORT_MATERIAL(Coateddiffuse, "coateddiffuse", kCoateddiffuseParams,
                      "diffuse ground under a transparent layer: plastic, varnish (random walks)",
                      /*reciprocal=*/true);
#endif
