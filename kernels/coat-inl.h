// The smooth or rough border between air and a transparent layer, for walks between the two:
// crossing it, being thrown back by it, and the values of both, from either side.
#if defined(SWELL_KERNELS_COAT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_COAT_INL_H_
#undef SWELL_KERNELS_COAT_INL_H_
#else
#define SWELL_KERNELS_COAT_INL_H_
#endif

#include "kernels/fresnel-inl.h"
#include "kernels/microfacet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// A direction drawn at the border. Void where `drawn` is false: then weight is 0 and wi any
// direction.
struct CoatDraw {
  Vec3 wi;
  F32 weight;  // f |cos(wi)| / pdf of importance: radiance also has 1 / (relative index)^2 across
  F32 pdf;     // rough only
  Mask drawn;
};
// f, without the cosine, and the density of drawing it.
struct CoatValue {
  F32 f;
  F32 pdf;
};

struct Coat {
  F32 eta;  // of the layer, below, over that of the air above
  Microfacets facets;
  bool smooth;

  // Through to the other side, for certain.
  HWY_INLINE CoatDraw Cross(const Vec3& w, F32 u0, F32 u1) const {
    const Mask below = hn::Lt(w.z, hn::Zero(D()));
    const Vec3 view = FlipZ(below, w);
    const F32 ratio = RelativeIndex(below);
    const Vec3 m = smooth ? Up() : facets.SampleVisible(view, u0, u1);
    const F32 cos_i = hn::Max(Dot(view, m), hn::Zero(D()));
    return Refracted(below, view, m, cos_i, RefractedCosine(cos_i, ratio), ratio);
  }

  // Back to where w is, for certain.
  HWY_INLINE CoatDraw Reflect(const Vec3& w, F32 u0, F32 u1) const {
    const Mask below = hn::Lt(w.z, hn::Zero(D()));
    const Vec3 view = FlipZ(below, w);
    const F32 ratio = RelativeIndex(below);
    const Vec3 m = smooth ? Up() : facets.SampleVisible(view, u0, u1);
    const F32 cos_i = hn::Max(Dot(view, m), hn::Zero(D()));
    const F32 share = FresnelDielectric(cos_i, RefractedCosine(cos_i, ratio), ratio);
    return Reflected(below, view, m, share);
  }

  // Either, with the probability of the reflected share. weight is free of that share.
  HWY_INLINE CoatDraw Scatter(const Vec3& w, F32 u0, F32 u1, F32 u2, Mask* reflected) const {
    const Mask below = hn::Lt(w.z, hn::Zero(D()));
    const Vec3 view = FlipZ(below, w);
    const F32 ratio = RelativeIndex(below);
    const Vec3 m = smooth ? Up() : facets.SampleVisible(view, u0, u1);
    const F32 cos_i = hn::Max(Dot(view, m), hn::Zero(D()));
    const F32 cos_t = RefractedCosine(cos_i, ratio);
    *reflected = hn::Lt(u2, FresnelDielectric(cos_i, cos_t, ratio));
    const CoatDraw back = Reflected(below, view, m, Set(1.0f));
    const CoatDraw on = Refracted(below, view, m, cos_i, cos_t, ratio);
    const F32 crossing = hn::Sub(Set(1.0f), FresnelDielectric(cos_i, cos_t, ratio));
    const F32 on_weight = hn::Div(on.weight, hn::Max(crossing, Set(1e-20f)));
    return {IfThenElse(*reflected, back.wi, on.wi),
            hn::IfThenElse(*reflected, back.weight, on_weight), hn::Zero(D()),
            hn::Or(hn::And(*reflected, back.drawn), AndNot(*reflected, on.drawn))};
  }

  // From w below to wi above, of radiance, and the density with which Cross draws w for wi: the
  // other way. 0 for a smooth border.
  HWY_INLINE CoatValue EvaluateOut(const Vec3& w, const Vec3& wi) const {
    const F32 zero = hn::Zero(D()), one = Set(1.0f);
    const Vec3 view = {w.x, w.y, hn::Neg(w.z)}, light = {wi.x, wi.y, hn::Neg(wi.z)};
    const F32 ratio = hn::Div(one, eta);
    const Vec3 sum = MulAdd(ratio, light, view);
    const F32 length = hn::CopySign(hn::Sqrt(Dot(sum, sum)), sum.z);
    const Vec3 m = {hn::Div(sum.x, length), hn::Div(sum.y, length), hn::Div(sum.z, length)};
    const F32 cos_i = Dot(view, m), cos_l = Dot(light, m);
    const Mask facing = hn::And(hn::Gt(cos_i, zero), hn::Lt(cos_l, zero));
    const F32 share = FresnelDielectric(cos_i, hn::Neg(cos_l), ratio);
    const F32 pdf = CrossingDensity(view, m, cos_i, cos_l, ratio);
    const Vec3 lit = {light.x, light.y, wi.z};
    const F32 across = hn::Mul(hn::Sub(one, share), facets.Shadowing(view, lit));
    const F32 f = hn::Div(hn::Mul(hn::Mul(across, pdf), hn::Mul(eta, eta)), wi.z);
    const F32 inward_pdf = CrossingDensity(lit, m, hn::Neg(cos_l), hn::Neg(cos_i), eta);
    const Mask valid = hn::And(facing, hn::And(hn::Gt(view.z, zero), hn::Gt(wi.z, zero)));
    return {hn::IfThenElseZero(valid, f), hn::IfThenElseZero(valid, inward_pdf)};
  }

  // The outer face's reflection, both directions above: f |cos(wi)| and its density. 0 if smooth.
  HWY_INLINE CoatValue EvaluateGloss(const Vec3& wo, const Vec3& wi) const {
    const F32 zero = hn::Zero(D());
    if (smooth) return {zero, zero};
    const Vec3 m = Normalize(Add(wo, wi));
    const F32 cos_i = Dot(wo, m);
    const F32 share = FresnelDielectric(cos_i, RefractedCosine(cos_i, eta), eta);
    const F32 pdf = hn::Mul(hn::Mul(Set(0.25f), share), facets.VisibleDensity(wo, m));
    return {hn::Mul(pdf, facets.Shadowing(wo, wi)), pdf};
  }

  // What a flat border of this index lets through at the cosine above it.
  HWY_INLINE F32 FlatCrossing(F32 cos_i) const {
    return hn::Sub(Set(1.0f), FresnelDielectric(cos_i, RefractedCosine(cos_i, eta), eta));
  }

 private:
  static HWY_INLINE Vec3 Up() { return {hn::Zero(D()), hn::Zero(D()), Set(1.0f)}; }

  // Of the medium beyond over that on the side of w.
  HWY_INLINE F32 RelativeIndex(Mask below) const {
    return hn::IfThenElse(below, hn::Div(Set(1.0f), eta), eta);
  }

  // Walter et al. 2007, eq. 17 with the density of visible normals; cos_l < 0.
  HWY_INLINE F32 CrossingDensity(const Vec3& view, const Vec3& m, F32 cos_i, F32 cos_l,
                                 F32 ratio) const {
    const F32 span = hn::Add(cos_l, hn::Div(cos_i, ratio));
    const F32 jacobian = hn::Div(hn::Abs(hn::Mul(cos_l, cos_i)), hn::Mul(span, span));
    return hn::Mul(jacobian, facets.VisibleDensity(view, m));
  }

  HWY_INLINE CoatDraw Refracted(Mask below, const Vec3& view, const Vec3& m, F32 cos_i, F32 cos_t,
                                F32 ratio) const {
    const F32 zero = hn::Zero(D());
    const F32 crossing = hn::Sub(Set(1.0f), FresnelDielectric(cos_i, cos_t, ratio));
    const F32 shrink = hn::Div(Set(1.0f), ratio);
    const F32 along = hn::MulSub(cos_i, shrink, cos_t);
    const Vec3 wi = Normalize(MulAdd(along, m, Neg(Scale(shrink, view))));
    // Both sides of a smooth border are certain; a facet may refract to the near one.
    const Mask drawn =
        hn::And(hn::And(hn::Gt(crossing, zero), hn::Gt(view.z, zero)), hn::Lt(wi.z, zero));
    const Vec3 lit = {wi.x, wi.y, hn::Neg(wi.z)};
    const F32 weight = smooth ? crossing : hn::Mul(crossing, facets.Shadowing(view, lit));
    const F32 pdf = smooth ? Set(1.0f) : CrossingDensity(view, m, cos_i, hn::Neg(cos_t), ratio);
    return {IfThenElse(drawn, FlipZ(below, wi), Up()), hn::IfThenElseZero(drawn, weight), pdf,
            drawn};
  }

  HWY_INLINE CoatDraw Reflected(Mask below, const Vec3& view, const Vec3& m, F32 share) const {
    const F32 zero = hn::Zero(D());
    const Vec3 wi = smooth ? MirrorDirection(view) : ReflectAbout(m, view);
    const Mask drawn =
        hn::And(hn::And(hn::Gt(share, zero), hn::Gt(view.z, zero)), hn::Gt(wi.z, zero));
    const F32 weight = smooth ? share : hn::Mul(share, facets.Shadowing(view, wi));
    return {IfThenElse(drawn, FlipZ(below, wi), Up()), hn::IfThenElseZero(drawn, weight), Set(1.0f),
            drawn};
  }
};

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_COAT_INL_H_
