// Metal, smooth or rough: mirror reflection, or that of GGX microfacets, weighted by the conductor
// Fresnel equations per colour channel. Light that a facet sends below the surface is lost.
#include "kernels/export_material.h"
#include "kernels/metals.h"
#include "kernels/microfacet_params.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/materials/conductor.cc"
#include <hwy/foreach_target.h>

#include "kernels/conductor-inl.h"
#include "kernels/shade-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

struct Conductor {
  ConductorSurface surface;

  Conductor(const Params& params, const PathSettings& /*settings*/)
      : surface(MakeConductor(params, params + 3, params + 6, params + 9, {1.0f, nullptr})) {}

  static constexpr bool kOpaque = true;
  static bool IsSpecular(const float* params) { return Microfacets::IsSmooth(params + 9); }
  static bool NeedsTangent(const float* params) { return Microfacets::IsStretched(params + 9); }

  HWY_INLINE BsdfValue Evaluate(const Vec3& wo, const Vec3& wi) const {
    return surface.Evaluate(wo, wi);
  }
  HWY_INLINE BsdfSample Sample(const Vec3& wo, F32 u0, F32 u1, F32 /*u2*/) const {
    return surface.Sample(wo, u0, u1);
  }
};

SWELL_MATERIAL_KERNELS(Conductor)

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell {
namespace {
[[maybe_unused]] constexpr ParamSpec kConductorParams[] = {
    {"eta",
     ParamType::kRgb,
     {kCuEta[0], kCuEta[1], kCuEta[2]},
     0.0f,
     100.0f,
     "real part of the index of refraction, or the name of a metal",
     kMetalEta,
     std::size(kMetalEta)},
    {"k",
     ParamType::kRgb,
     {kCuK[0], kCuK[1], kCuK[2]},
     0.0f,
     100.0f,
     "imaginary part of the index (absorption), or the name of a metal",
     kMetalK,
     std::size(kMetalK)},
    {"reflectance",
     ParamType::kRgb,
     {-1.0f, -1.0f, -1.0f},
     -1.0f,
     1.0f,
     "reflectance at normal incidence instead of eta and k; negative: unset",
     nullptr,
     0},
    SWELL_MICROFACET_PARAMS,
};
}  // namespace
}  // namespace swell

SWELL_EXPORT_MATERIAL(Conductor, "conductor", kConductorParams,
                      "metal, smooth or rough (GGX), by the conductor Fresnel equations",
                      /*reciprocal=*/true);
#endif
