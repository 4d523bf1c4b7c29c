// From hits to shading frames whose x axis runs along u, as the parametrisation of shapes says.
#if defined(SWELL_KERNELS_TANGENT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_TANGENT_INL_H_
#undef SWELL_KERNELS_TANGENT_INL_H_
#else
#define SWELL_KERNELS_TANGENT_INL_H_
#endif

#include "kernels/hit_surface-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// The frame of unit normal z whose x axis is the part of `along` in the surface. Where nothing of
// it is, any frame of z.
HWY_INLINE Frame MakeFrameAlong(const Vec3& z, const Vec3& along) {
  const Vec3 flat = MulAdd(hn::Neg(Dot(along, z)), z, along);
  const F32 length2 = Dot(flat, flat);
  const Mask usable = hn::Gt(length2, hn::Mul(Set(1e-10f), Dot(along, along)));
  const Frame any = MakeFrame(z);
  const Vec3 x = IfThenElse(usable, Normalize(IfThenElse(usable, flat, any.x)), any.x);
  return {x, Cross(z, x), z};
}

// dp/du of triangles, any length; 0 where u and v say nothing. A mesh without uvs has (0, 0),
// (1, 0), (1, 1) at the corners of every triangle, as in pbrt-v4.
HWY_INLINE Vec3 TriangleTangent(const SceneView& scene, U32 prim) {
  const F32 zero = hn::Zero(D()), one = Set(1.0f);
  const U32 at = hn::Add(hn::Add(prim, prim), prim);
  const U32 i0 = Gather(scene.indices, at);
  const U32 i1 = Gather(scene.indices + 1, at);
  const U32 i2 = Gather(scene.indices + 2, at);
  const Vec3 p0 = GatherXyz(scene.positions, i0);
  const Vec3 e1 = Sub(GatherXyz(scene.positions, i1), p0);
  const Vec3 e2 = Sub(GatherXyz(scene.positions, i2), p0);
  F32 du1 = one, dv1 = zero, du2 = one, dv2 = one;
  const U32 uv_offset = ShapeLanes(scene, prim).Word(offsetof(ShapeRecord, uv_offset));
  const MaskU mapped = hn::Ne(uv_offset, SetU(kNone));
  if (!hn::AllFalse(DU(), mapped)) {
    const Mask use = ToFloatMask(mapped);
    const auto uv = [&](U32 vertex) HWY_ATTR {
      const U32 row = hn::IfThenElseZero(mapped, hn::Add(vertex, uv_offset));
      return Vec2{Gather(scene.uvs, hn::Add(row, row)), Gather(scene.uvs + 1, hn::Add(row, row))};
    };
    const Vec2 uv0 = uv(i0), uv1 = uv(i1), uv2 = uv(i2);
    du1 = hn::IfThenElse(use, hn::Sub(uv1.x, uv0.x), du1);
    dv1 = hn::IfThenElse(use, hn::Sub(uv1.y, uv0.y), dv1);
    du2 = hn::IfThenElse(use, hn::Sub(uv2.x, uv0.x), du2);
    dv2 = hn::IfThenElse(use, hn::Sub(uv2.y, uv0.y), dv2);
  }
  const F32 determinant = hn::MulSub(du1, dv2, hn::Mul(dv1, du2));
  const Vec3 along = Sub(Scale(dv2, e1), Scale(dv1, e2));
  const Vec3 none = {zero, zero, zero};
  const Mask usable = hn::Gt(hn::Abs(determinant), Set(1e-9f));
  return IfThenElse(usable, Scale(hn::CopySignToAbs(one, determinant), along), none);
}

// dp/du of spheres: u is the angle around the z axis of their own space.
HWY_INLINE Vec3 SphereTangent(const SceneView& scene, U32 prim, const Vec3& hit_point) {
  const SphereLanes sphere(scene, ShapeLanes(scene, prim).Word(offsetof(ShapeRecord, sphere)));
  const Vec3 object = sphere.PointToObject(hit_point);
  const auto row = [&](size_t r) HWY_ATTR {
    return hn::MulSub(sphere.ToWorldEntry(r + 1), object.x,
                      hn::Mul(sphere.ToWorldEntry(r), object.y));
  };
  return {row(0), row(4), row(8)};
}

// `prim` must be valid in every lane.
HWY_INLINE Vec3 MakeTangent(const SceneView& scene, const Vec3& hit_point, U32 prim) {
  const Mask triangle = ToFloatMask(hn::Lt(prim, SetU(scene.triangle_count)));
  if (hn::AllTrue(D(), triangle)) return TriangleTangent(scene, prim);
  const U32 some_sphere = SetU(scene.triangle_count);
  const Vec3 sphere =
      SphereTangent(scene, hn::IfThenElse(ToUintMask(triangle), some_sphere, prim), hit_point);
  if (hn::AllFalse(D(), triangle)) return sphere;
  const Vec3 mesh = TriangleTangent(scene, hn::IfThenElseZero(ToUintMask(triangle), prim));
  return IfThenElse(triangle, mesh, sphere);
}

// The same in world space, of a hit whose primitive is instanced or not (`instance` is kNone).
HWY_INLINE Vec3 HitTangent(const SceneView& scene, const Vec3& hit_point, U32 instance, U32 prim) {
  const MaskU is_placed = hn::Ne(instance, SetU(kNone));
  if (hn::AllFalse(DU(), is_placed)) return MakeTangent(scene, hit_point, prim);
  const InstanceLanes lanes(scene, hn::IfThenElseZero(is_placed, instance));
  const Mask placed = ToFloatMask(is_placed);
  const Vec3 there = Mul(lanes.to_object, Sub(hit_point, lanes.centre));
  const Vec3 along = MakeTangent(scene, IfThenElse(placed, there, hit_point), prim);
  return IfThenElse(placed, Mul(lanes.to_world, along), along);
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_TANGENT_INL_H_
