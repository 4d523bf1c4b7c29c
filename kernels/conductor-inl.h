// A metal's surface, smooth or rough: mirror reflection or that of GGX microfacets, weighted by the
// conductor's Fresnel equations. Light that a facet sends below the surface is lost.
#if defined(SWELL_KERNELS_CONDUCTOR_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_CONDUCTOR_INL_H_
#undef SWELL_KERNELS_CONDUCTOR_INL_H_
#else
#define SWELL_KERNELS_CONDUCTOR_INL_H_
#endif

#include "kernels/fresnel-inl.h"
#include "kernels/microfacet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

struct ConductorSurface {
  Rgb eta, k;  // index over that of the medium in front of it
  Microfacets facets;
  bool specular;

  HWY_INLINE BsdfValue Evaluate(const Vec3& wo, const Vec3& wi) const {
    const F32 zero = hn::Zero(D());
    if (specular) return {{zero, zero, zero}, zero};
    const BsdfSample scattered = Scatter(wo, wi);
    return {Scale(scattered.pdf, scattered.weight), scattered.pdf};
  }

  HWY_INLINE BsdfSample Sample(const Vec3& wo, F32 u0, F32 u1) const {
    if (specular) {
      return ScatterIf(HasSide(wo), {MirrorDirection(wo), Reflected(AbsCosTheta(wo)),
                                     Set(kSpecularPdf), Set(1.0f)});
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
};

// Of a colour instead of a metal: the index 1 + i k with that reflectance at normal incidence.
HWY_INLINE F32 KOfReflectance(float reflectance) {
  const F32 r = hn::Min(Set(reflectance), Set(0.9999f));
  return hn::Mul(Set(2.0f), hn::Sqrt(hn::Div(r, hn::Sub(Set(1.0f), r))));
}

// `reflectance` stands for eta and k unless one of its channels is negative; `roughness` as
// Microfacets takes it; `outside` is the index of the medium in front.
HWY_INLINE ConductorSurface MakeConductor(const float* eta, const float* k,
                                          const float* reflectance, const float* roughness,
                                          float outside) {
  const F32 one = Set(1.0f), shrink = hn::Div(one, Set(outside));
  const bool metal = reflectance[0] < 0.0f || reflectance[1] < 0.0f || reflectance[2] < 0.0f;
  const Rgb real = metal ? BroadcastRgb(eta) : Rgb{one, one, one};
  const Rgb imaginary = metal ? BroadcastRgb(k)
                              : Rgb{KOfReflectance(reflectance[0]), KOfReflectance(reflectance[1]),
                                    KOfReflectance(reflectance[2])};
  return {Scale(shrink, real), Scale(shrink, imaginary), Microfacets(roughness),
          Microfacets::IsSmooth(roughness)};
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_CONDUCTOR_INL_H_
