// Metal, smooth or rough: mirror reflection, or that of GGX microfacets, weighted by the conductor
// Fresnel equations per colour channel. Light that a facet sends below the surface is lost.
#include "kernels/export_material.h"
#include "kernels/microfacet_params.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/materials/conductor.cc"
#include <hwy/foreach_target.h>

#include "kernels/fresnel-inl.h"
#include "kernels/microfacet-inl.h"
#include "kernels/shade-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

struct Conductor {
  Rgb eta, k;
  Microfacets facets;
  bool specular;

  Conductor(const Params& params, const PathSettings& /*settings*/)
      : eta(BroadcastRgb(params)),
        k(BroadcastRgb(params + 3)),
        facets(params + 9),
        specular(IsSpecular(params)) {
    if (params[6] < 0.0f || params[7] < 0.0f || params[8] < 0.0f) return;
    // A colour instead of a metal: the index 1 + i k with that reflectance at normal incidence.
    const F32 one = Set(1.0f);
    eta = {one, one, one};
    k = {KOfReflectance(params[6]), KOfReflectance(params[7]), KOfReflectance(params[8])};
  }

  static bool IsSpecular(const float* params) { return Microfacets::IsSmooth(params + 9); }

  HWY_INLINE BsdfValue Evaluate(const Vec3& wo, const Vec3& wi) const {
    const F32 zero = hn::Zero(D());
    if (specular) return {{zero, zero, zero}, zero};
    const BsdfSample scattered = Scatter(wo, wi);
    return {Scale(scattered.pdf, scattered.weight), scattered.pdf};
  }

  HWY_INLINE BsdfSample Sample(const Vec3& wo, F32 u0, F32 u1, F32 /*u2*/) const {
    if (specular) {
      return ScatterIf(HasSide(wo),
                       {MirrorDirection(wo), Reflected(AbsCosTheta(wo)), Set(1.0f), Set(1.0f)});
    }
    const Mask below = hn::Lt(wo.z, hn::Zero(D()));
    const Vec3 view = FlipZ(below, wo);
    const Vec3 wi = ReflectAbout(facets.SampleVisible(view, u0, u1), view);
    return Scatter(wo, FlipZ(below, wi));
  }

 private:
  HWY_INLINE Rgb Reflected(F32 cosine) const {
    const F32 cos_i = hn::Min(cosine, Set(1.0f));
    return {FresnelConductor(cos_i, eta.r, k.r), FresnelConductor(cos_i, eta.g, k.g),
            FresnelConductor(cos_i, eta.b, k.b)};
  }

  // Torrance and Sparrow: the facet is the half vector, dm / dwi = 1 / (4 wo.m).
  HWY_INLINE BsdfSample Scatter(const Vec3& wo, const Vec3& wi) const {
    const Mask below = hn::Lt(wo.z, hn::Zero(D()));
    const Vec3 view = FlipZ(below, wo), light = FlipZ(below, wi);
    const Vec3 m = Normalize(Add(view, light));
    const F32 pdf = hn::Mul(Set(0.25f), facets.VisibleDensity(view, m));
    const Rgb weight = Scale(facets.Shadowing(view, light), Reflected(Dot(view, m)));
    return ScatterIf(SameHemisphere(wo, wi), {wi, weight, pdf, Set(1.0f)});
  }

  static HWY_INLINE F32 KOfReflectance(const ParamWord& reflectance) {
    const F32 r = hn::Min(Set(reflectance), Set(0.9999f));
    return hn::Mul(Set(2.0f), hn::Sqrt(hn::Div(r, hn::Sub(Set(1.0f), r))));
  }
};

SWELL_MATERIAL_KERNELS(Conductor)

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell {
namespace {
// Measured n and k at 630, 532 and 465 nm, linear between the published wavelengths. Cu, Au, Ag:
// Johnson and Christy, Phys. Rev. B 6, 4370 (1972); Al: Rakic, Appl. Opt. 34, 4755 (1995).
constexpr float kCuEta[3] = {0.2753f, 1.1159f, 1.2469f};
constexpr float kCuK[3] = {3.3726f, 2.5956f, 2.4562f};
constexpr float kAuEta[3] = {0.1884f, 0.5439f, 1.3319f};
constexpr float kAuK[3] = {3.4034f, 2.2309f, 1.8693f};
constexpr float kAgEta[3] = {0.0569f, 0.0540f, 0.0469f};
constexpr float kAgK[3] = {4.2543f, 3.4290f, 2.8028f};
constexpr float kAlEta[3] = {1.4303f, 0.9388f, 0.6860f};
constexpr float kAlK[3] = {7.5081f, 6.4195f, 5.6351f};

constexpr NamedValue Named(const char* name, const float (&value)[3]) {
  return {name, {value[0], value[1], value[2]}};
}
[[maybe_unused]] constexpr NamedValue kMetalEta[] = {
    Named("metal-Cu-eta", kCuEta), Named("metal-Au-eta", kAuEta), Named("metal-Ag-eta", kAgEta),
    Named("metal-Al-eta", kAlEta), Named("Cu", kCuEta),           Named("Au", kAuEta),
    Named("Ag", kAgEta),           Named("Al", kAlEta),
};
[[maybe_unused]] constexpr NamedValue kMetalK[] = {
    Named("metal-Cu-k", kCuK), Named("metal-Au-k", kAuK), Named("metal-Ag-k", kAgK),
    Named("metal-Al-k", kAlK), Named("Cu", kCuK),         Named("Au", kAuK),
    Named("Ag", kAgK),         Named("Al", kAlK),
};

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
