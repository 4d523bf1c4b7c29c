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

// dp/du and dp/dv, any length; 0 where u and v say nothing.
struct UvAxes {
  Vec3 u, v;
};

// A mesh without uvs has (0, 0), (1, 0), (1, 1) at the corners of every triangle, as in pbrt-v4.
HWY_INLINE UvAxes TriangleAxes(const SceneView& scene, U32 prim) {
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
  const Vec3 along_u = Sub(Scale(dv2, e1), Scale(dv1, e2));
  const Vec3 along_v = Sub(Scale(du1, e2), Scale(du2, e1));
  const Vec3 none = {zero, zero, zero};
  const Mask usable = hn::Gt(hn::Abs(determinant), Set(1e-9f));
  const F32 sign = hn::CopySignToAbs(one, determinant);
  return {IfThenElse(usable, Scale(sign, along_u), none),
          IfThenElse(usable, Scale(sign, along_v), none)};
}

// Of spheres: u is the angle around the z axis of their own space. Of dp/dv only 0 is told.
HWY_INLINE UvAxes SphereAxes(const SceneView& scene, U32 prim, const Vec3& hit_point) {
  const SphereLanes sphere(scene, ShapeLanes(scene, prim).Word(offsetof(ShapeRecord, sphere)));
  const Vec3 object = sphere.PointToObject(hit_point);
  const auto row = [&](size_t r) HWY_ATTR {
    return hn::MulSub(sphere.ToWorldEntry(r + 1), object.x,
                      hn::Mul(sphere.ToWorldEntry(r), object.y));
  };
  const F32 zero = hn::Zero(D());
  return {{row(0), row(4), row(8)}, {zero, zero, zero}};
}

// `prim` must be valid in every lane.
HWY_INLINE UvAxes MakeAxes(const SceneView& scene, const Vec3& hit_point, U32 prim) {
  const Mask triangle = ToFloatMask(hn::Lt(prim, SetU(scene.triangle_count)));
  if (hn::AllTrue(D(), triangle)) return TriangleAxes(scene, prim);
  const U32 some_sphere = SetU(scene.triangle_count);
  const UvAxes sphere =
      SphereAxes(scene, hn::IfThenElse(ToUintMask(triangle), some_sphere, prim), hit_point);
  if (hn::AllFalse(D(), triangle)) return sphere;
  const UvAxes mesh = TriangleAxes(scene, hn::IfThenElseZero(ToUintMask(triangle), prim));
  return {IfThenElse(triangle, mesh.u, sphere.u), IfThenElse(triangle, mesh.v, sphere.v)};
}

// The same in world space, of a hit whose primitive is instanced or not (`instance` is kNone).
HWY_INLINE UvAxes HitAxes(const SceneView& scene, const Vec3& hit_point, U32 instance, U32 prim) {
  const MaskU is_placed = hn::Ne(instance, SetU(kNone));
  if (hn::AllFalse(DU(), is_placed)) return MakeAxes(scene, hit_point, prim);
  const InstanceLanes lanes(scene, hn::IfThenElseZero(is_placed, instance));
  const Mask placed = ToFloatMask(is_placed);
  const Vec3 there = Mul(lanes.to_object, Sub(hit_point, lanes.centre));
  const UvAxes axes = MakeAxes(scene, IfThenElse(placed, there, hit_point), prim);
  return {IfThenElse(placed, Mul(lanes.to_world, axes.u), axes.u),
          IfThenElse(placed, Mul(lanes.to_world, axes.v), axes.v)};
}

// The direction of growing u, in world space and of any length, 0 where u says nothing; and the
// sign of normal x along on the side to which v grows.
struct Tangent {
  Vec3 along;
  F32 side;
};

// Tangents of the vertices of `prim`, where the mesh has them, instead of what `tangent` is. Those
// of an instance that is a mirror have v on the other side, as uvs would.
inline HWY_NOINLINE void UseVertexTangents(const SceneView& scene, U32 instance, U32 prim, F32 b1,
                                           F32 b2, Tangent& tangent) {
  const F32 one = Set(1.0f), zero = hn::Zero(D());
  const U32 offset = Gather(scene.tangent_offsets, Gather(scene.prim_shape, prim));
  const MaskU given = hn::Ne(offset, SetU(kNone));
  if (hn::AllFalse(DU(), given)) return;
  const U32 first = hn::IfThenElseZero(given, hn::Add(hn::Add(prim, prim), prim));
  const F32 weights[3] = {hn::Sub(hn::Sub(one, b1), b2), b1, b2};
  Vec3 along = {zero, zero, zero};
  F32 side = zero;
  for (size_t k = 0; k < 3; ++k) {
    const U32 row = hn::Add(Gather(scene.indices + k, first), offset);
    const U32 word = hn::ShiftLeft<2>(hn::IfThenElseZero(given, row));
    const Vec3 vertex = {Gather(scene.tangents, word), Gather(scene.tangents + 1, word),
                         Gather(scene.tangents + 2, word)};
    along = MulAdd(weights[k], vertex, along);
    side = hn::MulAdd(weights[k], Gather(scene.tangents + 3, word), side);
  }
  const MaskU is_placed = hn::Ne(instance, SetU(kNone));
  if (!hn::AllFalse(DU(), is_placed)) {
    const Rows3 m = InstanceLanes(scene, hn::IfThenElseZero(is_placed, instance)).to_world;
    const Mask placed = ToFloatMask(is_placed);
    const Mask mirror = hn::And(placed, hn::Lt(Dot(m.x, Cross(m.y, m.z)), zero));
    along = IfThenElse(placed, Mul(m, along), along);
    side = hn::IfThenElse(mirror, hn::Neg(side), side);
  }
  const Mask use = hn::And(ToFloatMask(given), hn::Gt(Dot(along, along), zero));
  tangent.along = IfThenElse(use, along, tangent.along);
  tangent.side = hn::IfThenElse(use, hn::CopySign(one, side), tangent.side);
}

// Of a hit of normal n, whose u and v grow along `axes` in the world.
HWY_INLINE Tangent HitTangent(const SceneView& scene, const Vec3& n, const UvAxes& axes,
                              U32 instance, U32 prim, F32 b1, F32 b2) {
  Tangent tangent = {axes.u, hn::CopySign(Set(1.0f), Dot(Cross(n, axes.u), axes.v))};
  if (scene.tangent_offsets != nullptr) {
    UseVertexTangents(scene, instance, prim, b1, b2, tangent);
  }
  return tangent;
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_TANGENT_INL_H_
