// Metal under a layer with a smooth or rough dielectric border: lacquered or anodised metal.
#include "kernels/export_material.h"
#include "kernels/layer_params.h"
#include "kernels/metals.h"
#include "kernels/transparent_media.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/materials/coatedconductor.cc"
#include <hwy/foreach_target.h>

#include "kernels/conductor-inl.h"
#include "kernels/layered-inl.h"
#include "kernels/shade-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

struct ConductorGround {
  ConductorSurface surface;
  bool specular;

  HWY_INLINE BsdfValue Evaluate(const Vec3& wo, const Vec3& wi) const {
    return surface.Evaluate(wo, wi);
  }
  HWY_INLINE BsdfSample Sample(const Vec3& wo, F32 u0, F32 u1, F32 /*u2*/) const {
    return surface.Sample(wo, u0, u1);
  }
  // As if the coat were flat, and its facets the metal's.
  HWY_INLINE F32 Proxy(const Coat& coat, const Vec3& wo, const Vec3& wi) const {
    if (specular && coat.smooth) return hn::Zero(D());
    Microfacets facets = surface.facets;
    const Microfacets& above = coat.facets;
    facets.alpha_x = Widened(facets.alpha_x, above.alpha_x);
    facets.alpha_y = Widened(facets.alpha_y, above.alpha_y);
    const Vec3 view = Inside(coat.eta, wo), light = Inside(coat.eta, wi);
    const F32 density = facets.VisibleDensity(view, Normalize(Add(view, light)));
    // dwi inside over dwi outside.
    const F32 squeeze = hn::Div(wi.z, hn::Mul(light.z, hn::Mul(coat.eta, coat.eta)));
    return hn::Mul(hn::Mul(Set(0.25f), density), squeeze);
  }

 private:
  static HWY_INLINE F32 Widened(F32 a, F32 b) {
    return hn::Min(hn::Sqrt(hn::MulAdd(a, a, hn::Mul(b, b))), Set(1.0f));
  }
  static HWY_INLINE Vec3 Inside(F32 eta, const Vec3& w) {
    const F32 cosine = hn::Max(RefractedCosine(w.z, eta), Set(1e-3f));
    return {hn::Div(w.x, eta), hn::Div(w.y, eta), cosine};
  }
};

struct Coatedconductor {
  Layered<ConductorGround> layered;

  Coatedconductor(const Params& params, const PathSettings& /*settings*/)
      : layered{MakeCoat(params), MakeGround(params), Layer(params + 17)} {}

  static constexpr bool kOpaque = true;
  static bool IsSpecular(const float* params) {
    const bool clear = params[19] == 0.0f && params[20] == 0.0f && params[21] == 0.0f;
    return clear && Microfacets::IsSmooth(CoatRoughness(Params(params)).words) &&
           Microfacets::IsSmooth(GroundRoughness(Params(params)).words);
  }
  static bool NeedsTangent(const float* params) {
    return Microfacets::IsStretched(CoatRoughness(Params(params)).words) ||
           Microfacets::IsStretched(GroundRoughness(Params(params)).words);
  }

  HWY_INLINE BsdfValue Evaluate(const Vec3& wo, const Vec3& wi, U32 seed) const {
    return layered.Evaluate(wo, wi, seed);
  }
  HWY_INLINE BsdfSample Sample(const Vec3& wo, F32 u0, F32 u1, F32 u2, U32 seed) const {
    return layered.Sample(wo, u0, u1, u2, seed);
  }

 private:
  // As Microfacets takes it; both surfaces share remaproughness.
  struct Roughness {
    float words[4];
    const float* columns[4];

    Roughness(const ParamWord& a, const ParamWord& u, const ParamWord& v, const ParamWord& remap)
        : words{a, u, v, remap}, columns{a.column, u.column, v.column, nullptr} {}
    Params params() const { return Params(words, columns, 0); }
  };
  static Roughness CoatRoughness(const Params& p) { return {p[0], p[1], p[2], p[16]}; }
  static Roughness GroundRoughness(const Params& p) { return {p[13], p[14], p[15], p[16]}; }

  static Coat MakeCoat(const Params& params) {
    const Roughness roughness = CoatRoughness(params);
    return {Set(params[3]), Microfacets(roughness.params()),
            Microfacets::IsSmooth(roughness.words)};
  }
  static ConductorGround MakeGround(const Params& params) {
    const Roughness roughness = GroundRoughness(params);
    return {MakeConductor(params + 4, params + 7, params + 10, roughness.params(), params[3]),
            Microfacets::IsSmooth(roughness.words)};
  }
};

SWELL_MATERIAL_KERNELS(Coatedconductor)

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell {
namespace {
[[maybe_unused]] constexpr ParamSpec kCoatedconductorParams[] = {
    {"interface.roughness",
     ParamType::kFloat,
     {0.0f},
     0.0f,
     1.0f,
     "GGX roughness of the layer's border in both directions; 0 is smooth",
     nullptr,
     0},
    {"interface.uroughness",
     ParamType::kFloat,
     {-1.0f},
     -1.0f,
     1.0f,
     "along u; negative: as interface.roughness",
     nullptr,
     0},
    {"interface.vroughness",
     ParamType::kFloat,
     {-1.0f},
     -1.0f,
     1.0f,
     "along v; negative: as interface.roughness",
     nullptr,
     0},
    {"interface.eta",
     ParamType::kFloat,
     {1.5f},
     0.1f,
     10.0f,
     "index of refraction of the layer, or the name of a medium",
     kTransparentMedia,
     std::size(kTransparentMedia)},
    {"conductor.eta",
     ParamType::kRgb,
     {kCuEta[0], kCuEta[1], kCuEta[2]},
     0.0f,
     100.0f,
     "real part of the metal's index of refraction, or the name of a metal",
     kMetalEta,
     std::size(kMetalEta)},
    {"conductor.k",
     ParamType::kRgb,
     {kCuK[0], kCuK[1], kCuK[2]},
     0.0f,
     100.0f,
     "imaginary part of the metal's index, or the name of a metal",
     kMetalK,
     std::size(kMetalK)},
    {"reflectance",
     ParamType::kRgb,
     {-1.0f, -1.0f, -1.0f},
     -1.0f,
     1.0f,
     "reflectance of the bare metal instead of conductor.eta and .k; negative: unset",
     nullptr,
     0},
    {"conductor.roughness",
     ParamType::kFloat,
     {0.0f},
     0.0f,
     1.0f,
     "GGX roughness of the metal in both directions; 0 is smooth",
     nullptr,
     0},
    {"conductor.uroughness",
     ParamType::kFloat,
     {-1.0f},
     -1.0f,
     1.0f,
     "along u; negative: as conductor.roughness",
     nullptr,
     0},
    {"conductor.vroughness",
     ParamType::kFloat,
     {-1.0f},
     -1.0f,
     1.0f,
     "along v; negative: as conductor.roughness",
     nullptr,
     0},
    {"remaproughness",
     ParamType::kBool,
     {1.0f},
     0.0f,
     1.0f,
     "whether GGX's alpha is the square root of the roughness, or the roughness itself",
     nullptr,
     0},
    SWELL_LAYER_PARAMS,
};
}  // namespace
}  // namespace swell

SWELL_EXPORT_MATERIAL(Coatedconductor, "coatedconductor", kCoatedconductorParams,
                      "metal under a transparent layer: lacquered metal (random walks)",
                      /*reciprocal=*/true);
#endif
