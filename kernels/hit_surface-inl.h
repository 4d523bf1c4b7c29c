// A hit in, its surface in world space out, whether its primitive is instanced or not.
#if defined(SWELL_KERNELS_HIT_SURFACE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_HIT_SURFACE_INL_H_
#undef SWELL_KERNELS_HIT_SURFACE_INL_H_
#else
#define SWELL_KERNELS_HIT_SURFACE_INL_H_
#endif

#include <cstddef>

#include "kernels/surface-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

struct Rows3 {
  Vec3 x, y, z;
};
HWY_INLINE Vec3 Mul(const Rows3& m, const Vec3& v) {
  return {Dot(m.x, v), Dot(m.y, v), Dot(m.z, v)};
}
HWY_INLINE Rows3 Abs(const Rows3& m) { return {Abs(m.x), Abs(m.y), Abs(m.z)}; }

// InstanceRecords, gathered.
struct InstanceLanes {
  Rows3 to_object, to_world;
  Vec3 centre;

  InstanceLanes(const SceneView& scene, U32 instance) {
    const float* words = reinterpret_cast<const float*>(scene.instances);
    const U32 at = hn::Mul(instance, SetU(sizeof(InstanceRecord) / 4));
    const auto vector = [&](size_t offset) HWY_ATTR {
      const float* from = words + offset / 4;
      return Vec3{Gather(from, at), Gather(from + 1, at), Gather(from + 2, at)};
    };
    const auto rows = [&](size_t offset) HWY_ATTR {
      return Rows3{vector(offset), vector(offset + 12), vector(offset + 24)};
    };
    to_object = rows(offsetof(InstanceRecord, to_object));
    to_world = rows(offsetof(InstanceRecord, to_world));
    centre = vector(offsetof(InstanceRecord, centre));
  }

  // Normals go by the transpose of the map back, which leaves the outside outside, also in a
  // mirror. Not of unit length.
  HWY_INLINE Vec3 Normal(const Vec3& n) const {
    return MulAdd(n.x, to_object.x, MulAdd(n.y, to_object.y, Scale(n.z, to_object.z)));
  }
};

// What rounding makes of a point p of an object on its way to the world and back, which a ray from
// it takes: in the world, 4 roundings of to_world p + centre and one of to_world itself; in the
// object, 4 of to_object (q - centre) and one of to_object.
struct PlaceRounding {
  Vec3 in_world, in_object;
};
HWY_INLINE PlaceRounding RoundingOf(const InstanceLanes& instance, const Vec3& p) {
  const Vec3 there = Mul(Abs(instance.to_world), Abs(p));
  return {Scale(Set(Gamma(5)), Add(there, Abs(instance.centre))),
          Scale(Set(Gamma(6)), Mul(Abs(instance.to_object), there))};
}

// A surface of an object where an instance puts it. A plane at distance h in the object is at h /
// |m| in the world, m the normal there before it is made a unit one. So the error is taken along
// the normal, all that OffsetOrigin asks for: a box in the object becomes too large a box in the
// world where the map stretches.
HWY_INLINE Surface PlaceSurface(const InstanceLanes& instance, const Surface& s) {
  const PlaceRounding rounding = RoundingOf(instance, s.p);
  const Vec3 m = instance.Normal(s.n);
  const F32 length = hn::Sqrt(Dot(m, m));
  const F32 in_object = hn::Div(Dot(Abs(s.n), Add(s.error, rounding.in_object)), length);
  Surface placed = s;
  placed.p = Add(Mul(instance.to_world, s.p), instance.centre);
  placed.n = {hn::Div(m.x, length), hn::Div(m.y, length), hn::Div(m.z, length)};
  placed.ns = Normalize(instance.Normal(s.ns));
  const Vec3 n = Abs(placed.n);
  placed.error = Scale(hn::Add(in_object, Dot(n, rounding.in_world)), n);
  return placed;
}

// `prim` must be valid in every lane; `instance` is kNone where it is not instanced. Instanced
// surfaces do not emit, so their area_scale has no meaning.
HWY_INLINE Surface HitSurface(const SceneView& scene, const Vec3& org, const Vec3& dir, F32 t,
                              U32 instance, U32 prim, F32 u, F32 v) {
  const MaskU is_placed = hn::Ne(instance, SetU(kNone));
  if (hn::AllFalse(DU(), is_placed)) return MakeSurface(scene, org, dir, t, prim, u, v);
  const InstanceLanes lanes(scene, hn::IfThenElseZero(is_placed, instance));
  const Mask placed = ToFloatMask(is_placed);
  const Vec3 o = IfThenElse(placed, Mul(lanes.to_object, Sub(org, lanes.centre)), org);
  const Vec3 d = IfThenElse(placed, Mul(lanes.to_object, dir), dir);
  const PlaceRounding rounding = RoundingOf(lanes, MulAdd(t, d, o));
  const Vec3 in_object = Add(rounding.in_object, Mul(Abs(lanes.to_object), rounding.in_world));
  const F32 twice = hn::Mul(Set(2.0f), MaxComponent(in_object));
  const Surface s = MakeSurface(scene, o, d, t, prim, u, v, hn::IfThenElseZero(placed, twice));
  const Surface there = PlaceSurface(lanes, s);
  return {IfThenElse(placed, there.p, s.p), IfThenElse(placed, there.error, s.error),
          IfThenElse(placed, there.n, s.n), IfThenElse(placed, there.ns, s.ns), s.area_scale};
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_HIT_SURFACE_INL_H_
