// Where a ray met the scene: point with its rounding bound, normals and frame, from hit columns.
#if defined(SWELL_KERNELS_SURFACE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_SURFACE_INL_H_
#undef SWELL_KERNELS_SURFACE_INL_H_
#else
#define SWELL_KERNELS_SURFACE_INL_H_
#endif

#include <cstddef>

#include "kernels/lanes-inl.h"
#include "kernels/scene_view.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

// Bound on the relative error of n roundings (Higham 2002, lemma 3.1).
HWY_INLINE constexpr float Gamma(int n) {
  constexpr float kUnit = 0x1p-24f;
  return (static_cast<float>(n) * kUnit) / (1.0f - static_cast<float>(n) * kUnit);
}

// ---------------------------------------------------------------- frames
struct Frame {
  Vec3 x, y, z;  // orthonormal
};
// Duff et al. 2017, "Building an Orthonormal Basis, Revisited", JCGT 6(1).
HWY_INLINE Frame MakeFrame(const Vec3& z) {
  const F32 one = Set(1.0f);
  const F32 sign = hn::CopySignToAbs(one, z.z);
  const F32 a = hn::Div(Set(-1.0f), hn::Add(sign, z.z));
  const F32 b = hn::Mul(hn::Mul(z.x, z.y), a);
  return {{hn::MulAdd(hn::Mul(hn::Mul(sign, z.x), z.x), a, one), hn::Mul(sign, b),
           hn::Mul(hn::Neg(sign), z.x)},
          {b, hn::MulAdd(hn::Mul(z.y, z.y), a, sign), hn::Neg(z.y)},
          z};
}
HWY_INLINE Vec3 ToLocal(const Frame& f, const Vec3& v) {
  return {Dot(f.x, v), Dot(f.y, v), Dot(f.z, v)};
}
HWY_INLINE Vec3 ToWorld(const Frame& f, const Vec3& v) {
  return MulAdd(v.x, f.x, MulAdd(v.y, f.y, Scale(v.z, f.z)));
}

// ---------------------------------------------------------------- leaving a surface
// The next float away from zero's side `up`: towards +infinity or -infinity.
HWY_INLINE F32 NextFloat(F32 v, Mask up) {
  const U32 one = SetU(1);
  const U32 bits = Bits(hn::Add(v, hn::Zero(D())));  // -0 becomes +0
  const Mask negative = hn::Lt(v, hn::Zero(D()));
  const MaskU grow = ToUintMask(hn::Xor(up, negative));
  const U32 stepped = hn::IfThenElse(grow, hn::Add(bits, one), hn::Sub(bits, one));
  const MaskU zero_down = hn::AndNot(ToUintMask(up), hn::Eq(bits, hn::Zero(DU())));
  return FromBits(hn::IfThenElse(zero_down, SetU(0x80000001u), stepped));
}

HWY_INLINE F32 RoundAway(F32 p, F32 offset) {
  const F32 moved = hn::Add(p, offset);
  const Mask up = hn::Gt(offset, hn::Zero(D()));
  const Mask still = hn::Eq(offset, hn::Zero(D()));
  return hn::IfThenElse(still, moved, NextFloat(moved, up));
}

// p moved along the normal n to the side of w, beyond the box of half-widths `error` in which the
// exact surface point lies (Pharr, Jakob & Humphreys 2023, 6.8.6).
HWY_INLINE Vec3 OffsetOrigin(const Vec3& p, const Vec3& error, const Vec3& n, const Vec3& w) {
  const F32 distance = Dot(Abs(n), error);
  const Mask inward = hn::Lt(Dot(n, w), hn::Zero(D()));
  const Vec3 offset = Scale(hn::IfThenElse(inward, hn::Neg(distance), distance), n);
  return {RoundAway(p.x, offset.x), RoundAway(p.y, offset.y), RoundAway(p.z, offset.z)};
}

// ---------------------------------------------------------------- spheres
struct SpherePoint {
  Vec3 p, error;   // world space
  Vec3 n;          // unit, outward
  F32 area_scale;  // world area per area of the unit sphere, here
};

// Affine images of the unit sphere, gathered.
class SphereLanes {
 public:
  SphereLanes(const SceneView& scene, U32 sphere)
      : words_(reinterpret_cast<const float*>(scene.spheres)),
        at_(hn::Mul(sphere, SetU(sizeof(SphereRecord) / 4))) {}

  HWY_INLINE F32 ToWorldEntry(size_t i) const { return Gather(words_ + i, at_); }
  HWY_INLINE F32 ToObjectEntry(size_t i) const { return Gather(words_ + 12 + i, at_); }

  HWY_INLINE Vec3 PointToObject(const Vec3& p) const {
    const auto row = [&](size_t r) HWY_ATTR {
      return hn::MulAdd(ToObjectEntry(r), p.x,
                        hn::MulAdd(ToObjectEntry(r + 1), p.y,
                                   hn::MulAdd(ToObjectEntry(r + 2), p.z, ToObjectEntry(r + 3))));
    };
    return {row(0), row(4), row(8)};
  }

  // A world normal to object space: by the transpose of object_to_world.
  HWY_INLINE Vec3 NormalToObject(const Vec3& n) const {
    const auto column = [&](size_t c) HWY_ATTR {
      return hn::MulAdd(ToWorldEntry(c), n.x,
                        hn::MulAdd(ToWorldEntry(c + 4), n.y, hn::Mul(ToWorldEntry(c + 8), n.z)));
    };
    return {column(0), column(1), column(2)};
  }

  // The point of the unit sphere `object` (unit length) in the world.
  HWY_INLINE SpherePoint PointAt(const Vec3& object) const {
    const F32 bound = Set(Gamma(8));  // rounding of `object` (5) and of the map (3)
    Vec3 p, error, n;
    const auto map = [&](size_t r, F32& point, F32& rounding) HWY_ATTR {
      const F32 x = hn::Mul(ToWorldEntry(r), object.x);
      const F32 y = hn::Mul(ToWorldEntry(r + 1), object.y);
      const F32 z = hn::Mul(ToWorldEntry(r + 2), object.z);
      const F32 w = ToWorldEntry(r + 3);
      point = hn::Add(hn::Add(x, y), hn::Add(z, w));
      rounding =
          hn::Mul(bound, hn::Add(hn::Add(hn::Abs(x), hn::Abs(y)), hn::Add(hn::Abs(z), hn::Abs(w))));
    };
    map(0, p.x, error.x);
    map(4, p.y, error.y);
    map(8, p.z, error.z);
    const auto column = [&](size_t c) HWY_ATTR {
      return hn::MulAdd(
          ToObjectEntry(c), object.x,
          hn::MulAdd(ToObjectEntry(c + 4), object.y, hn::Mul(ToObjectEntry(c + 8), object.z)));
    };
    n = {column(0), column(1), column(2)};
    const F32 length = hn::Sqrt(Dot(n, n));
    const F32 determinant = hn::Abs(Determinant());
    return {p,
            error,
            {hn::Div(n.x, length), hn::Div(n.y, length), hn::Div(n.z, length)},
            hn::Mul(determinant, length)};
  }

 private:
  HWY_INLINE F32 Determinant() const {
    const Vec3 a{ToWorldEntry(0), ToWorldEntry(1), ToWorldEntry(2)};
    const Vec3 b{ToWorldEntry(4), ToWorldEntry(5), ToWorldEntry(6)};
    const Vec3 c{ToWorldEntry(8), ToWorldEntry(9), ToWorldEntry(10)};
    return Dot(a, Cross(b, c));
  }

  const float* words_;
  U32 at_;
};

// ---------------------------------------------------------------- hits
struct Surface {
  Vec3 p;          // world space
  Vec3 error;      // half-widths of a box through which the exact surface passes
  Vec3 n;          // geometric normal, unit, on the outer side
  Vec3 ns;         // shading normal, unit
  F32 area_scale;  // spheres: see SpherePoint; 1 for triangles
};

// Words of ShapeRecords, gathered.
class ShapeLanes {
 public:
  ShapeLanes(const SceneView& scene, U32 prim)
      : words_(reinterpret_cast<const uint32_t*>(scene.shapes)),
        at_(hn::ShiftLeft<3>(Gather(scene.prim_shape, prim))) {}
  HWY_INLINE U32 Word(size_t offset) const { return Gather(words_ + offset / 4, at_); }
  HWY_INLINE Mask Flag(uint32_t flag) const {
    return ToFloatMask(hn::TestBit(Word(offsetof(ShapeRecord, flags)), SetU(flag)));
  }

 private:
  const uint32_t* words_;
  U32 at_;
};

HWY_INLINE Vec3 GatherXyz(const float* base, U32 row) {
  const U32 at = hn::Add(hn::Add(row, row), row);
  return {Gather(base, at), Gather(base + 1, at), Gather(base + 2, at)};
}

// The triangle that a point lies on, for bounds: the largest component of the edge opposite to each
// vertex, of all edges, and twice the area.
struct TriangleSize {
  F32 edge0, edge1, edge2, edge, area2;
};
HWY_INLINE TriangleSize MeasureTriangle(const Vec3& e1, const Vec3& e2, F32 area2) {
  const F32 edge0 = MaxComponent(Abs(Sub(e2, e1)));
  const F32 edge1 = MaxComponent(Abs(e2));
  const F32 edge2 = MaxComponent(Abs(e1));
  return {edge0, edge1, edge2, hn::Max(edge0, hn::Max(edge1, edge2)), area2};
}

// How far off its plane the intersection test may see a triangle: a ray from nearer than this can
// find the triangle that it leaves. The test's edge functions are off by some r D^2 (r = 2^-24, D
// the longest edge), so barycentrics by r D^2 / area2 and points by r D^3 / area2. Of 10^7 rays
// from triangles of aspects 1 to 10^4, the factors 2 and above let none find its own. Bounded for
// needles, whose rays would start far away.
HWY_INLINE F32 TriangleTestError(const TriangleSize& size) {
  constexpr float kUnit = 0x1p-24f, kFactor = 8.0f, kMaxAspect = 256.0f;
  const F32 aspect = hn::Div(hn::Mul(size.edge, size.edge), size.area2);
  const F32 bounded = hn::Min(hn::Max(aspect, Set(1.0f)), Set(kMaxAspect));
  return hn::Mul(Set(kFactor * kUnit), hn::Mul(size.edge, bounded));
}

// Moves a point that is nearer to an edge than `distance` to about that distance. Where walls meet,
// a point beyond the edge by its rounding would lie behind the next wall, and light would leak.
HWY_INLINE void MoveInside(const TriangleSize& size, F32 distance, F32& u, F32& v) {
  const F32 most = Set(0x1p-8f);  // needles again
  const F32 scale = hn::Div(distance, size.area2);
  u = hn::Max(u, hn::Min(hn::Mul(scale, size.edge1), most));
  v = hn::Max(v, hn::Min(hn::Mul(scale, size.edge2), most));
  const F32 w = hn::Sub(hn::Sub(Set(1.0f), u), v);
  const F32 lack = hn::Max(hn::Sub(hn::Min(hn::Mul(scale, size.edge0), most), w), hn::Zero(D()));
  const Mask u_larger = hn::Gt(u, v);
  u = hn::Sub(u, hn::IfThenElseZero(u_larger, lack));
  v = hn::Sub(v, hn::IfThenZeroElse(u_larger, lack));
}

// `rounding`: what the point's way to the world and back may add to its own, for instances; else 0.
HWY_INLINE Surface TriangleSurface(const SceneView& scene, U32 prim, F32 u, F32 v, F32 rounding) {
  const U32 at = hn::Add(hn::Add(prim, prim), prim);
  const U32 i0 = Gather(scene.indices, at);
  const U32 i1 = Gather(scene.indices + 1, at);
  const U32 i2 = Gather(scene.indices + 2, at);
  const Vec3 p0 = GatherXyz(scene.positions, i0);
  const Vec3 p1 = GatherXyz(scene.positions, i1);
  const Vec3 p2 = GatherXyz(scene.positions, i2);
  const Vec3 e1 = Sub(p1, p0);
  const Vec3 e2 = Sub(p2, p0);
  const Vec3 area = Cross(e1, e2);
  const TriangleSize size = MeasureTriangle(e1, e2, hn::Sqrt(Dot(area, area)));
  const F32 reach = MaxComponent(Max(Abs(p0), Max(Abs(p1), Abs(p2))));
  const F32 w = hn::Sub(hn::Sub(Set(1.0f), u), v);
  F32 inner_u = u, inner_v = v;
  const F32 own_rounding = hn::Mul(Set(2.0f * Gamma(7)), hn::Add(reach, size.edge));
  MoveInside(size, hn::Add(own_rounding, rounding), inner_u, inner_v);
  const Vec3 a = Scale(hn::Sub(hn::Sub(Set(1.0f), inner_u), inner_v), p0);
  const Vec3 b = Scale(inner_u, p1);
  const Vec3 c = Scale(inner_v, p2);

  Surface s;
  s.p = Add(a, Add(b, c));
  const F32 test_error = TriangleTestError(size);
  const Vec3 test = {test_error, test_error, test_error};
  s.error = MulAdd(Set(Gamma(7)), Add(Abs(a), Add(Abs(b), Abs(c))), test);
  s.n = Normalize(area);
  s.area_scale = Set(1.0f);
  const ShapeLanes shape(scene, prim);
  s.n = IfThenElse(shape.Flag(kShapeFlipNormal), Neg(s.n), s.n);
  s.ns = s.n;
  const U32 normal_offset = shape.Word(offsetof(ShapeRecord, normal_offset));
  const MaskU smooth = hn::Ne(normal_offset, SetU(kNone));
  if (!hn::AllFalse(DU(), smooth)) {
    const auto normal = [&](U32 vertex) HWY_ATTR {
      return GatherXyz(scene.normals, hn::IfThenElseZero(smooth, hn::Add(vertex, normal_offset)));
    };
    const Vec3 ns = Add(Scale(w, normal(i0)), Add(Scale(u, normal(i1)), Scale(v, normal(i2))));
    const Mask use = hn::And(ToFloatMask(smooth), hn::Gt(Dot(ns, ns), hn::Zero(D())));
    s.ns = IfThenElse(use, Normalize(ns), s.n);
    // The vertices' normals say which side is the outer one.
    const Mask against =
        hn::And(hn::Lt(Dot(s.n, s.ns), hn::Zero(D())), shape.Flag(kShapeNormalsOrient));
    s.n = IfThenElse(against, Neg(s.n), s.n);
  }
  return s;
}

HWY_INLINE Surface SphereSurface(const SceneView& scene, U32 prim, const Vec3& hit_point) {
  const ShapeLanes shape(scene, prim);
  const SphereLanes sphere(scene, shape.Word(offsetof(ShapeRecord, sphere)));
  // The hit point has the error of t; put back onto the sphere it has the rounding of one division.
  const SpherePoint at = sphere.PointAt(Normalize(sphere.PointToObject(hit_point)));
  const Vec3 n = IfThenElse(shape.Flag(kShapeFlipNormal), Neg(at.n), at.n);
  return {at.p, at.error, n, n, at.area_scale};
}

// `prim` must be valid in every lane; `rounding` as for triangles.
HWY_INLINE Surface MakeSurface(const SceneView& scene, const Vec3& org, const Vec3& dir, F32 t,
                               U32 prim, F32 u, F32 v, F32 rounding = hn::Zero(D())) {
  const U32 triangle_count = SetU(scene.triangle_count);
  const Mask triangle = ToFloatMask(hn::Lt(prim, triangle_count));
  if (hn::AllTrue(D(), triangle)) return TriangleSurface(scene, prim, u, v, rounding);
  const U32 first_sphere = triangle_count;
  const Surface sphere = SphereSurface(
      scene, hn::IfThenElse(ToUintMask(triangle), first_sphere, prim), MulAdd(t, dir, org));
  if (hn::AllFalse(D(), triangle)) return sphere;
  const Surface mesh =
      TriangleSurface(scene, hn::IfThenElseZero(ToUintMask(triangle), prim), u, v, rounding);
  return {IfThenElse(triangle, mesh.p, sphere.p), IfThenElse(triangle, mesh.error, sphere.error),
          IfThenElse(triangle, mesh.n, sphere.n), IfThenElse(triangle, mesh.ns, sphere.ns),
          hn::IfThenElse(triangle, mesh.area_scale, sphere.area_scale)};
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_SURFACE_INL_H_
