// Texture coordinates of hits, and how fast they change over the surface.
#if defined(SWELL_KERNELS_SURFACE_UV_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_SURFACE_UV_INL_H_
#undef SWELL_KERNELS_SURFACE_UV_INL_H_
#else
#define SWELL_KERNELS_SURFACE_UV_INL_H_
#endif

#include "kernels/sphere_map-inl.h"
#include "kernels/surface-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

struct SurfaceUv {
  F32 u, v;
  Vec3 dpdu, dpdv;  // 0 where the parametrisation is degenerate
  F32 du, dv;       // most that u and v change per length on the surface
};

// First row of a mesh's coordinates as ShapeRecord::uv_offset; of its second ones if it has some.
HWY_INLINE U32 UvOffset(const SceneView& scene, U32 prim, bool second) {
  const U32 first = ShapeLanes(scene, prim).Word(offsetof(ShapeRecord, uv_offset));
  if (!second || scene.second_uv_offsets == nullptr) return first;
  const U32 offset = Gather(scene.second_uv_offsets, Gather(scene.prim_shape, prim));
  return hn::IfThenElse(hn::Ne(offset, SetU(kNone)), offset, first);
}

// Triangles: u and v of the vertices; (0, 0), (1, 0), (1, 1) where a mesh has none, as in pbrt-v4.
HWY_INLINE SurfaceUv TriangleUv(const SceneView& scene, U32 prim, F32 b1, F32 b2, bool second) {
  const F32 zero = hn::Zero(D()), one = Set(1.0f);
  const U32 at = hn::Add(hn::Add(prim, prim), prim);
  const U32 i0 = Gather(scene.indices, at);
  const U32 i1 = Gather(scene.indices + 1, at);
  const U32 i2 = Gather(scene.indices + 2, at);
  const U32 uv_offset = UvOffset(scene, prim, second);
  const MaskU mapped = hn::Ne(uv_offset, SetU(kNone));
  F32 u0 = zero, v0 = zero, u1 = one, v1 = zero, u2 = one, v2 = one;
  if (!hn::AllFalse(DU(), mapped)) {
    const auto read = [&](U32 vertex, F32& u, F32& v) HWY_ATTR {
      const U32 row = hn::IfThenElseZero(mapped, hn::Add(vertex, uv_offset));
      const U32 word = hn::Add(row, row);
      u = hn::IfThenElse(ToFloatMask(mapped), Gather(scene.uvs, word), u);
      v = hn::IfThenElse(ToFloatMask(mapped), Gather(scene.uvs + 1, word), v);
    };
    read(i0, u0, v0);
    read(i1, u1, v1);
    read(i2, u2, v2);
  }
  const F32 b0 = hn::Sub(hn::Sub(one, b1), b2);
  SurfaceUv s;
  s.u = hn::MulAdd(b0, u0, hn::MulAdd(b1, u1, hn::Mul(b2, u2)));
  s.v = hn::MulAdd(b0, v0, hn::MulAdd(b1, v1, hn::Mul(b2, v2)));

  const Vec3 p0 = GatherXyz(scene.positions, i0);
  const Vec3 e1 = Sub(GatherXyz(scene.positions, i1), p0);
  const Vec3 e2 = Sub(GatherXyz(scene.positions, i2), p0);
  const F32 du1 = hn::Sub(u1, u0), du2 = hn::Sub(u2, u0);
  const F32 dv1 = hn::Sub(v1, v0), dv2 = hn::Sub(v2, v0);
  const F32 determinant = hn::MulSub(du1, dv2, hn::Mul(dv1, du2));
  const Mask usable = hn::Gt(hn::Abs(determinant), Set(1e-9f));
  const F32 inverse =
      hn::IfThenElseZero(usable, hn::Div(one, hn::IfThenElse(usable, determinant, one)));
  s.dpdu = Scale(inverse, Sub(Scale(dv2, e1), Scale(dv1, e2)));
  s.dpdv = Scale(inverse, Sub(Scale(du1, e2), Scale(du2, e1)));

  // Gradients of the weights of the 2nd and 3rd vertex lie in the plane.
  const Vec3 area = Cross(e1, e2);
  const F32 scale = hn::Div(one, Dot(area, area));
  const Vec3 g1 = Scale(scale, Cross(e2, area)), g2 = Scale(scale, Cross(area, e1));
  const Vec3 gu = MulAdd(du1, g1, Scale(du2, g2)), gv = MulAdd(dv1, g1, Scale(dv2, g2));
  s.du = hn::Sqrt(Dot(gu, gu));
  s.dv = hn::Sqrt(Dot(gv, gv));
  return s;
}

// Weights of the 2nd and 3rd vertex at points of triangles; of spheres anything.
HWY_INLINE Vec2 WeightsAt(const SceneView& scene, U32 prim, const Vec3& point) {
  const MaskU triangle = hn::Lt(prim, SetU(scene.triangle_count));
  const F32 zero = hn::Zero(D());
  if (hn::AllFalse(DU(), triangle)) return {zero, zero};
  const U32 safe = hn::IfThenElseZero(triangle, prim);
  const U32 at = hn::Add(hn::Add(safe, safe), safe);
  const Vec3 p0 = GatherXyz(scene.positions, Gather(scene.indices, at));
  const Vec3 e1 = Sub(GatherXyz(scene.positions, Gather(scene.indices + 1, at)), p0);
  const Vec3 e2 = Sub(GatherXyz(scene.positions, Gather(scene.indices + 2, at)), p0);
  const Vec3 area = Cross(e1, e2), to = Sub(point, p0);
  const F32 scale = hn::Div(Set(1.0f), Dot(area, area));
  return {hn::Mul(scale, Dot(Cross(e2, area), to)), hn::Mul(scale, Dot(Cross(area, e1), to))};
}

// Spheres: u goes around z, v from -z (0) to z (1). hit_point is in the world.
HWY_INLINE SurfaceUv SphereUv(const SceneView& scene, U32 prim, const Vec3& hit_point) {
  const SphereLanes sphere(scene, ShapeLanes(scene, prim).Word(offsetof(ShapeRecord, sphere)));
  const Vec3 w = Normalize(sphere.PointToObject(hit_point));
  const Vec2 at = SphereToLatLong(w);
  const auto to_world = [&](const Vec3& d) HWY_ATTR {
    const auto row = [&](size_t r) HWY_ATTR {
      return hn::MulAdd(
          sphere.ToWorldEntry(r), d.x,
          hn::MulAdd(sphere.ToWorldEntry(r + 1), d.y, hn::Mul(sphere.ToWorldEntry(r + 2), d.z)));
    };
    return Vec3{row(0), row(4), row(8)};
  };
  SurfaceUv s;
  s.u = at.x;
  s.v = hn::Sub(Set(1.0f), at.y);
  const F32 zero = hn::Zero(D()), turn = Set(2.0f * kPi), half_turn = Set(kPi);
  const F32 flat = hn::Sqrt(hn::Max(hn::MulAdd(w.x, w.x, hn::Mul(w.y, w.y)), Set(1e-12f)));
  const F32 cos = hn::Div(w.x, flat), sin = hn::Div(w.y, flat);
  s.dpdu = Scale(turn, to_world({hn::Neg(w.y), w.x, zero}));
  s.dpdv =
      Scale(half_turn, to_world({hn::Neg(hn::Mul(w.z, cos)), hn::Neg(hn::Mul(w.z, sin)), flat}));
  const auto inverse = [](const Vec3& v) HWY_ATTR {
    return hn::Div(Set(1.0f), hn::Max(hn::Sqrt(Dot(v, v)), Set(1e-12f)));
  };
  s.du = inverse(s.dpdu);
  s.dv = inverse(s.dpdv);
  return s;
}

// `prim` must be valid in every lane; b1 and b2 are weights of a triangle's 2nd and 3rd vertex.
HWY_INLINE SurfaceUv MakeSurfaceUv(const SceneView& scene, U32 prim, F32 b1, F32 b2,
                                   const Vec3& hit_point, bool second = false) {
  const U32 triangle_count = SetU(scene.triangle_count);
  const Mask triangle = ToFloatMask(hn::Lt(prim, triangle_count));
  if (hn::AllTrue(D(), triangle)) return TriangleUv(scene, prim, b1, b2, second);
  const SurfaceUv sphere =
      SphereUv(scene, hn::IfThenElse(ToUintMask(triangle), triangle_count, prim), hit_point);
  if (hn::AllFalse(D(), triangle)) return sphere;
  const SurfaceUv mesh =
      TriangleUv(scene, hn::IfThenElseZero(ToUintMask(triangle), prim), b1, b2, second);
  return {
      hn::IfThenElse(triangle, mesh.u, sphere.u),   hn::IfThenElse(triangle, mesh.v, sphere.v),
      IfThenElse(triangle, mesh.dpdu, sphere.dpdu), IfThenElse(triangle, mesh.dpdv, sphere.dpdv),
      hn::IfThenElse(triangle, mesh.du, sphere.du), hn::IfThenElse(triangle, mesh.dv, sphere.dv)};
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_SURFACE_UV_INL_H_
