// Points that look at triangle lights -> directions, uniform in solid angle or in area, and the
// solid angles that such lights fill.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/triangle_lights.cc"
#include <hwy/foreach_target.h>

#include "kernels/image_lights-inl.h"
#include "kernels/light_lanes-inl.h"
#include "kernels/sampling-inl.h"
#include "kernels/surface-inl.h"
#include "kernels/triangle_lights-inl.h"
HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// Within these solid angles [sr] a triangle is sampled by solid angle, else by area. Below 0.1 sr
// cos / d^2 hardly varies: in the Cornell box the error at equal time is the same from 0.1 to 0.5,
// and 3 % more at 0.01. Above the other bound the point is nearer to the triangle than a thousandth
// of its size, and rounding of the distance shows.
inline constexpr float kTanOfHalfLeast = 0.0500417f;  // of 0.1 sr
inline constexpr float kMostSolidAngle = 6.28f;

struct TriangleSeen {
  Vec3 p0, e1, e2, n;  // first vertex, edges, unit normal
  F32 area;
  Vec3 to_a;       // from the point to the first vertex
  Vec3 a, b, c;    // unit vectors to the vertices
  F32 ab, bc, ca;  // dot products of these
  F32 volume;      // |a (b x c)|
  F32 angle;       // solid angle
  Mask by_angle;
};

// Solid angle by Van Oosterom and Strackee 1983: tan(angle / 2) = |a (b x c)| / (1 + ab + bc + ca).
HWY_INLINE TriangleSeen SeeTriangle(const LightLanes& light, const Vec3& from) {
  const F32 one = Set(1.0f), zero = hn::Zero(D());
  TriangleSeen s;
  s.p0 = light.Vector(offsetof(LightRecord, p));
  s.e1 = light.Vector(offsetof(LightRecord, e1));
  s.e2 = light.Vector(offsetof(LightRecord, e2));
  s.n = light.Vector(offsetof(LightRecord, n));
  s.area = light.Float(offsetof(LightRecord, area));
  s.to_a = Sub(s.p0, from);
  const Vec3 to_b = Add(s.to_a, s.e1), to_c = Add(s.to_a, s.e2);
  const F32 inv_a = hn::Div(one, hn::Sqrt(Dot(s.to_a, s.to_a)));
  const F32 inv_b = hn::Div(one, hn::Sqrt(Dot(to_b, to_b)));
  const F32 inv_c = hn::Div(one, hn::Sqrt(Dot(to_c, to_c)));
  s.a = Scale(inv_a, s.to_a);
  s.b = Scale(inv_b, to_b);
  s.c = Scale(inv_c, to_c);
  s.ab = Dot(s.a, s.b);
  s.bc = Dot(s.b, s.c);
  s.ca = Dot(s.c, s.a);
  // Twice the area times the height: no cancellation for small triangles.
  const F32 height = hn::Abs(Dot(s.n, s.to_a));
  const F32 twice_area = hn::Mul(Set(2.0f), s.area);
  s.volume = hn::Mul(hn::Mul(hn::Mul(twice_area, inv_a), inv_b), hn::Mul(height, inv_c));
  const F32 sum = hn::Add(hn::Add(one, s.ab), hn::Add(s.bc, s.ca));
  s.angle = zero;
  s.by_angle = hn::Or(hn::Gt(s.volume, hn::Mul(sum, Set(kTanOfHalfLeast))), hn::Le(sum, zero));
  if (hn::AllFalse(D(), s.by_angle)) return s;
  const F32 half = hn::Atan(D(), hn::Div(s.volume, sum));  // sum = 0: the arc of infinity
  const F32 positive = hn::IfThenElse(hn::Lt(sum, zero), hn::Add(half, Set(kPi)), half);
  s.angle = hn::Mul(Set(2.0f), positive);
  s.by_angle = hn::And(s.by_angle, hn::Lt(s.angle, Set(kMostSolidAngle)));
  return s;
}

// A direction uniform in the spherical triangle. The map is Arvo's (1995, "Stratified sampling of
// spherical triangles"): w on the arc from a to c cuts off a triangle a b w of u0 of the area; the
// direction lies on the arc from b to w, its cosine to b uniform. w mirrors a about o, in whose
// terms the formula for the solid angle is linear (Peters 2021, "BRDF Importance Sampling for
// Polygonal Lights"), so that nothing cancels for small triangles.
HWY_INLINE Vec3 UniformInTriangle(const TriangleSeen& s, F32 u0, F32 u1) {
  const F32 one = Set(1.0f), half = Set(0.5f);
  F32 sin, cos;  // of half the area of a b w
  SinCosTurns(hn::Mul(hn::Mul(half, Set(kInvTwoPi)), hn::Mul(u0, s.angle)), &sin, &cos);
  const F32 along_a = hn::NegMulAdd(hn::Add(s.ca, s.bc), sin, hn::Mul(s.volume, cos));
  const F32 along_c = hn::Mul(hn::Add(one, s.ab), sin);
  const Vec3 o = MulAdd(along_a, s.a, Scale(along_c, s.c));
  const F32 twice = hn::Div(hn::Mul(Set(2.0f), Dot(s.a, o)), Dot(o, o));
  const Vec3 w = Sub(Scale(twice, o), s.a);

  const Vec3 chord = Sub(w, s.b);
  const F32 one_minus_cos = hn::Mul(half, Dot(chord, chord));
  const Vec3 across = Normalize(MulAdd(one_minus_cos, s.b, chord));
  const F32 x = hn::Mul(u1, one_minus_cos);
  const F32 sin_b = hn::Sqrt(hn::Max(hn::Mul(x, hn::Sub(Set(2.0f), x)), hn::Zero(D())));
  return MulAdd(sin_b, across, Scale(hn::Sub(one, x), s.b));
}

// Barycentric weights of the second and the third vertex.
struct Weights {
  F32 b1, b2;
};

// Where a direction meets the triangle's plane, put back inside what rounding moved out.
HWY_INLINE Weights MeetTriangle(const TriangleSeen& s, const Vec3& dir) {
  const F32 zero = hn::Zero(D());
  const Vec3 from_a = Neg(s.to_a);
  const Vec3 h = Cross(dir, s.e2);
  const F32 inverse = hn::Div(Set(1.0f), Dot(s.e1, h));
  const F32 b1 = hn::Max(hn::Mul(Dot(from_a, h), inverse), zero);
  const F32 b2 = hn::Max(hn::Mul(Dot(dir, Cross(from_a, s.e1)), inverse), zero);
  const F32 sum = hn::Max(hn::Add(b1, b2), Set(1.0f));
  return {hn::Div(b1, sum), hn::Div(b2, sum)};
}

// Uniform in area (Heitz 2019, "A Low-Distortion Map Between Triangle and Square").
HWY_INLINE Weights UniformInArea(F32 u0, F32 u1) {
  const Mask upper = hn::Gt(u1, u0);
  const F32 small = hn::Mul(Set(0.5f), hn::Min(u0, u1));
  const F32 large = hn::Sub(hn::Max(u0, u1), small);
  return {hn::IfThenElse(upper, small, large), hn::IfThenElse(upper, large, small)};
}

void SampleTriangleLights(const LightsView& lights, TriangleLightLanes& lanes) {
  const LightLanes light(lights, hn::Load(DU(), lanes.light));
  const Vec3 from = LoadLanes(lanes.from);
  const F32 u0 = hn::Load(D(), lanes.u0), u1 = hn::Load(D(), lanes.u1);
  const TriangleSeen seen = SeeTriangle(light, from);
  Weights weights = UniformInArea(u0, u1);
  if (!hn::AllFalse(D(), seen.by_angle)) {
    const Weights met = MeetTriangle(seen, UniformInTriangle(seen, u0, u1));
    weights = {hn::IfThenElse(seen.by_angle, met.b1, weights.b1),
               hn::IfThenElse(seen.by_angle, met.b2, weights.b2)};
  }

  const Vec3 point = MulAdd(weights.b2, seen.e2, MulAdd(weights.b1, seen.e1, seen.p0));
  // Rounding of p0 + b1 e1 + b2 e2, and of e1, e2 themselves.
  const Vec3 error = Scale(Set(Gamma(6)), Add(Abs(seen.p0), Add(Abs(seen.e1), Abs(seen.e2))));
  const Vec3 to_light = Sub(point, from);
  const F32 distance2 = Dot(to_light, to_light);
  const Vec3 wi = Normalize(to_light);
  const F32 cos = hn::Neg(Dot(seen.n, wi));
  const Mask shines = hn::Or(hn::Gt(cos, hn::Zero(D())), light.two_sided());
  const F32 pdf_area = hn::Div(distance2, hn::Mul(hn::Abs(cos), seen.area));
  const F32 pdf = hn::IfThenElse(seen.by_angle, hn::Div(Set(1.0f), seen.angle), pdf_area);
  const Mask valid =
      hn::And(shines, hn::And(hn::Gt(distance2, hn::Zero(D())), hn::Lt(pdf, Set(kLargestPdf))));
  StoreLanes(wi, lanes.wi);
  const F32 extent = MaxComponent(Add(Abs(seen.e1), Abs(seen.e2)));
  StoreLanes(ShadowRayEnd(point, error, seen.n, from, extent), lanes.end);
  hn::Store(hn::IfThenElseZero(valid, pdf), D(), lanes.pdf);
}

void FindTriangleAngles(const LightsView& lights, TriangleLightLanes& lanes) {
  const LightLanes light(lights, hn::Load(DU(), lanes.light));
  const TriangleSeen seen = SeeTriangle(light, LoadLanes(lanes.from));
  hn::Store(hn::IfThenElseZero(seen.by_angle, seen.angle), D(), lanes.angle);
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
