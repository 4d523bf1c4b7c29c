// Lights as lanes: choosing one, drawing a point on it, and the density of having done so.
#if defined(SWELL_KERNELS_LIGHTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_LIGHTS_INL_H_
#undef SWELL_KERNELS_LIGHTS_INL_H_
#else
#define SWELL_KERNELS_LIGHTS_INL_H_
#endif

#include <cstddef>

#include "kernels/image_lights-inl.h"
#include "kernels/light_lanes-inl.h"
#include "kernels/light_tree-inl.h"
#include "kernels/sampling-inl.h"
#include "kernels/surface-inl.h"
#include "kernels/triangle_lights-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// A triangle: by solid angle or by area, see triangle_lights.cc.
HWY_INLINE void SampleTriangleLight(const LightsView& lights, U32 index, const Vec3& p, F32 u0,
                                    F32 u1, Mask triangle, LightSample& s) {
  TriangleLightLanes lanes;
  StoreTriangleQuery(p, index, lanes);
  hn::Store(u0, D(), lanes.u0);
  hn::Store(u1, D(), lanes.u1);
  SampleTriangleLights(lights, lanes);
  s.wi = IfThenElse(triangle, LoadLanes(lanes.wi), s.wi);
  s.end = IfThenElse(triangle, LoadLanes(lanes.end), s.end);
  s.pdf = hn::IfThenElse(triangle, hn::Load(D(), lanes.pdf), s.pdf);
}

// From nearer to a sphere than this (sin^2 of its cone's half angle), it is sampled by area: there
// rounding decides on which side of the surface a point lies, and both densities must agree.
inline constexpr float kWidestCone = 0.9999f;

// Cone of directions that a sphere fills, seen from p (outside of it).
struct SphereCone {
  Vec3 axis;          // unit, to the centre
  F32 distance2;      // to the centre
  F32 sin2_max;       // of the half angle; 1 or more from inside
  F32 one_minus_cos;  // of the half angle
};
HWY_INLINE SphereCone MakeSphereCone(const Vec3& centre, F32 radius, const Vec3& p) {
  const Vec3 to_centre = Sub(centre, p);
  const F32 distance2 = Dot(to_centre, to_centre);
  const F32 sin2 = hn::Div(hn::Mul(radius, radius), distance2);
  const F32 cos = hn::Sqrt(hn::Max(hn::Sub(Set(1.0f), sin2), hn::Zero(D())));
  // 1 - cos = sin^2 / (1 + cos) does not cancel for small spheres.
  return {Normalize(to_centre), distance2, sin2, hn::Div(sin2, hn::Add(Set(1.0f), cos))};
}

// Sphere: uniformly in its cone of directions (Pharr, Jakob & Humphreys 2023, 6.2.4); from inside,
// and for ellipsoids, uniformly over the unit sphere of object space.
HWY_INLINE void SampleSphereLight(const SceneView& scene, const LightLanes& light, Mask is_cone,
                                  const Vec3& p, F32 u0, F32 u1, Mask lanes, LightSample& s) {
  const F32 one = Set(1.0f);
  const Vec3 centre = light.Vector(offsetof(LightRecord, p));
  const F32 radius = light.Float(offsetof(LightRecord, area));
  const SphereCone cone = MakeSphereCone(centre, radius, p);
  const Mask outside = hn::And(is_cone, hn::Lt(cone.sin2_max, Set(kWidestCone)));
  const SphereLanes sphere(scene, light.Word(offsetof(LightRecord, sphere)));

  // In the cone: the angle at p, then the point where that ray first meets the sphere.
  const F32 one_minus_cos = hn::Mul(u0, cone.one_minus_cos);
  const F32 sin2 = hn::Mul(one_minus_cos, hn::Sub(Set(2.0f), one_minus_cos));
  const F32 cos = hn::Sub(one, one_minus_cos);
  F32 sin_phi, cos_phi;
  SinCosTurns(u1, &sin_phi, &cos_phi);
  const F32 sin = hn::Sqrt(sin2);
  const Frame frame = MakeFrame(cone.axis);
  const Vec3 wi_cone = ToWorld(frame, {hn::Mul(sin, cos_phi), hn::Mul(sin, sin_phi), cos});
  const F32 along = hn::Mul(hn::Sqrt(cone.distance2), cos);
  const F32 half_chord2 = hn::Sub(hn::Mul(radius, radius), hn::Mul(cone.distance2, sin2));
  const F32 t = hn::Sub(along, hn::Sqrt(hn::Max(half_chord2, hn::Zero(D()))));
  const Vec3 n_cone = Normalize(Sub(MulAdd(t, wi_cone, p), centre));
  const F32 pdf_cone = hn::Div(Set(kInvTwoPi), cone.one_minus_cos);

  // By area.
  const Vec3 unit = UniformSphere(u0, u1);
  const Vec3 unit_cone = sphere.NormalToObject(n_cone);
  const Vec3 object = IfThenElse(outside, Normalize(unit_cone), unit);
  const SpherePoint at = sphere.PointAt(object);
  const Vec3 to_light = Sub(at.p, p);
  const F32 distance2 = Dot(to_light, to_light);
  const Vec3 wi_area = Normalize(to_light);
  const F32 cos_light = hn::Neg(Dot(at.n, wi_area));
  const F32 pdf_area =
      hn::Div(hn::Mul(distance2, Set(kInvFourPi)), hn::Mul(hn::Abs(cos_light), at.area_scale));

  const Vec3 wi = IfThenElse(outside, wi_cone, wi_area);
  const F32 pdf = hn::IfThenElse(outside, pdf_cone, pdf_area);
  const Mask from_outside = hn::Or(outside, hn::Gt(cos_light, hn::Zero(D())));
  const Mask shines = hn::Or(hn::Xor(from_outside, light.inward()), light.two_sided());
  const Mask valid = hn::And(shines, hn::Lt(pdf, Set(kLargestPdf)));
  s.wi = IfThenElse(lanes, wi, s.wi);
  s.end = IfThenElse(lanes, ShadowRayEnd(at.p, at.error, at.n, p, radius), s.end);
  s.pdf = hn::IfThenElse(lanes, hn::IfThenElseZero(valid, pdf), s.pdf);
}

// Share of its intensity that a spot light sends at this cosine from its axis: a cubic between the
// cosine at which it has faded and that at which it begins to.
HWY_INLINE F32 SpotFalloff(const LightLanes& light, F32 cos) {
  const F32 zero = hn::Zero(D()), one = Set(1.0f);
  const F32 full = light.Float(offsetof(LightRecord, e1));
  const F32 dark = light.Float(offsetof(LightRecord, e1) + 4);
  const F32 span = hn::Max(hn::Sub(full, dark), Set(1e-12f));  // 0: a sharp edge
  const F32 x = hn::Min(hn::Max(hn::Div(hn::Sub(cos, dark), span), zero), one);
  return hn::Mul(hn::Mul(x, x), hn::NegMulAdd(Set(2.0f), x, Set(3.0f)));
}

HWY_INLINE void SamplePointLight(const LightLanes& light, U32 type, const Vec3& p, Mask lanes,
                                 LightSample& s) {
  const Vec3 position = light.Vector(offsetof(LightRecord, p));
  const Vec3 to_light = Sub(position, p);
  const F32 distance2 = Dot(to_light, to_light);
  const Vec3 wi = Normalize(to_light);
  F32 falloff = hn::IfThenElseZero(hn::Gt(distance2, hn::Zero(D())), hn::Div(Set(1.0f), distance2));
  const Mask spot = IsType(type, kSpotLight);
  if (!hn::AllFalse(D(), spot)) {
    const F32 cos = hn::Neg(Dot(light.Vector(offsetof(LightRecord, n)), wi));
    falloff = hn::IfThenElse(spot, hn::Mul(falloff, SpotFalloff(light, cos)), falloff);
  }
  s.wi = IfThenElse(lanes, wi, s.wi);
  s.end = IfThenElse(lanes, position, s.end);
  s.pdf = hn::IfThenElse(lanes, Set(1.0f), s.pdf);
  s.radiance = IfThenElse(lanes, Scale(falloff, s.radiance), s.radiance);
}

// Lights whose emission is an image, after all else is known of them.
HWY_INLINE void ApplyImages(const SceneView& scene, const LightLanes& light, F32 u0, F32 u1,
                            LightSample& s) {
  const Mask pictured = light.pictured();
  if (hn::AllFalse(D(), pictured)) return;
  ImageLightLanes q;
  const U32 image = light.Word(offsetof(LightRecord, image));
  hn::Store(hn::IfThenElse(ToUintMask(pictured), image, SetU(kNone)), DU(), q.image);
  hn::Store(light.Word(offsetof(LightRecord, prim)), DU(), q.prim);
  hn::Store(u0, D(), q.u0);
  hn::Store(u1, D(), q.u1);
  hn::Store(hn::IfThenElseZero(ToUintMask(light.unseen()), SetU(1)), DU(), q.whole);
  StoreLanes(s.end, q.point);
  StoreLanes(s.wi, q.wi);
  StoreLanes({s.radiance.r, s.radiance.g, s.radiance.b}, q.radiance);
  hn::Store(s.pdf, D(), q.pdf);
  SampleImageLights(scene, q);
  s.wi = LoadLanes(q.wi);
  const Vec3 radiance = LoadLanes(q.radiance);
  s.radiance = {radiance.x, radiance.y, radiance.z};
  s.pdf = hn::Load(D(), q.pdf);
}

// Draws a light and a point on it for the surface points p, whose `side` (EncodeNormal) receives.
HWY_INLINE LightSample SampleLight(const SceneView& scene, const Vec3& p, U32 side, F32 u_select,
                                   F32 u0, F32 u1) {
  const LightChoice choice = ChooseLight(scene.lights, p, side, u_select);
  const U32 index = choice.light;
  const LightLanes light(scene.lights, index);
  const U32 type = light.type();
  const F32 zero = hn::Zero(D());
  const F32 one = Set(1.0f);

  LightSample s{{zero, zero, one}, p,    IsType(type, kDistantLight),
                light.radiance(),  zero, IsType(type, kDistantLight)};
  const Mask triangle = IsType(type, kTriangleLight);
  if (!hn::AllFalse(D(), triangle))
    SampleTriangleLight(scene.lights, index, p, u0, u1, triangle, s);
  const Mask cone = IsType(type, kSphereLight);
  const Mask sphere = hn::Or(cone, IsType(type, kEllipsoidLight));
  if (!hn::AllFalse(D(), sphere)) SampleSphereLight(scene, light, cone, p, u0, u1, sphere, s);
  const Mask beam = hn::And(ToFloatMask(hn::Gt(type, SetU(kInfiniteLight))),
                            ToFloatMask(hn::Lt(type, SetU(kImageInfiniteLight))));
  const Mask point = hn::Or(IsType(type, kPointLight), beam);
  if (!hn::AllFalse(D(), point)) SamplePointLight(light, type, p, point, s);
  const Mask distant = s.at_infinity;
  s.wi = IfThenElse(distant, light.Vector(offsetof(LightRecord, p)), s.wi);
  s.pdf = hn::IfThenElse(distant, one, s.pdf);
  const Mask infinite = IsType(type, kInfiniteLight);
  if (!hn::AllFalse(D(), infinite)) {
    s.wi = IfThenElse(infinite, UniformSphere(u0, u1), s.wi);
    s.pdf = hn::IfThenElse(infinite, Set(kInvFourPi), s.pdf);
    s.at_infinity = hn::Or(s.at_infinity, infinite);
  }
  if (scene.lights.any_pictured) {
    ApplyImages(scene, light, u0, u1, s);
    s.at_infinity = hn::Or(s.at_infinity, IsType(type, kImageInfiniteLight));
  }
  s.pdf = hn::Mul(s.pdf, choice.pdf);
  s.is_delta = hn::Or(s.is_delta, point);
  if (scene.lights.any_unseen) s.is_delta = hn::Or(s.is_delta, light.unseen());
  return s;
}

// Density with which SampleLight, from `org` and its `side`, draws the direction that hit light
// `index` at distance t. `cos` is the cosine at the light between its geometric normal and the way
// back, of either sign.
HWY_INLINE F32 LightPdf(const LightsView& lights, U32 index, const Vec3& org, U32 side, F32 t,
                        F32 cos, F32 area_scale) {
  const LightLanes light(lights, index);
  const U32 type = light.type();
  const F32 abs_cos = hn::Abs(cos);
  const F32 t2 = hn::Mul(t, t);
  const F32 area = light.Float(offsetof(LightRecord, area));
  F32 pdf = hn::Div(t2, hn::Mul(abs_cos, area));
  const Mask triangle = IsType(type, kTriangleLight);
  if (!hn::AllFalse(D(), triangle)) {
    TriangleLightLanes lanes;
    StoreTriangleQuery(org, index, lanes);
    FindTriangleAngles(lights, lanes);
    const F32 angle = hn::Load(D(), lanes.angle);
    const Mask by_angle = hn::And(triangle, hn::Gt(angle, hn::Zero(D())));
    pdf = hn::IfThenElse(by_angle, hn::Div(Set(1.0f), angle), pdf);
  }
  const Mask cone = IsType(type, kSphereLight);
  const Mask sphere = hn::Or(cone, IsType(type, kEllipsoidLight));
  if (!hn::AllFalse(D(), sphere)) {
    const SphereCone seen = MakeSphereCone(light.Vector(offsetof(LightRecord, p)), area, org);
    const Mask outside = hn::And(cone, hn::Lt(seen.sin2_max, Set(kWidestCone)));
    const F32 by_area = hn::Div(hn::Mul(t2, Set(kInvFourPi)), hn::Mul(abs_cos, area_scale));
    const F32 by_cone = hn::Div(Set(kInvTwoPi), seen.one_minus_cos);
    pdf = hn::IfThenElse(sphere, hn::IfThenElse(outside, by_cone, by_area), pdf);
  }
  return hn::Mul(hn::Min(pdf, Set(kLargestPdf)), ChoicePdf(lights, org, side, index));
}

// Power heuristic of two single samples (Veach 1997, 9.2.3), for densities up to infinity.
HWY_INLINE F32 PowerHeuristic(F32 pdf, F32 other) {
  const F32 ratio = hn::Div(other, pdf);
  return hn::Div(Set(1.0f), hn::MulAdd(ratio, ratio, Set(1.0f)));
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_LIGHTS_INL_H_
