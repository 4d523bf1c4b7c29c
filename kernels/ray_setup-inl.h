// Rays in, what boxes and triangles need to know of them out: over any vector type, so that a ray
// alone and a ray among others get the same bits, in the world and in an object's space.
#if defined(SWELL_KERNELS_RAY_SETUP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_RAY_SETUP_INL_H_
#undef SWELL_KERNELS_RAY_SETUP_INL_H_
#else
#define SWELL_KERNELS_RAY_SETUP_INL_H_
#endif

#include "kernels/triangle-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

template <class DT> HWY_INLINE hn::Vec<DT> InfinityOf(DT dt) {
  return hn::BitCast(dt, hn::Set(hn::RebindToUnsigned<DT>(), 0x7F800000u));
}

inline constexpr float kMostFinite = 0x1.fffffep127f;

template <class DT, class V = hn::Vec<DT>>
HWY_INLINE hn::Mask<DT> IsFinite(DT dt, const Vec3T<V>& org, const Vec3T<V>& dir) {
  const V most = hn::Set(dt, kMostFinite);
  const Vec3T<V> o = Abs(org), d = Abs(dir);
  return hn::And(hn::And(hn::And(hn::Le(o.x, most), hn::Le(o.y, most)),
                         hn::And(hn::Le(o.z, most), hn::Le(d.x, most))),
                 hn::And(hn::Le(d.y, most), hn::Le(d.z, most)));
}

// 1 / dir, but not so large that a slab's distance overflows.
template <class V> HWY_INLINE V LimitedInverse(V one, V dir, V limit) {
  return hn::CopySign(hn::Min(hn::Abs(hn::Div(one, dir)), limit), dir);
}

template <class DT, class V = hn::Vec<DT>>
HWY_INLINE Slabs<V> MakeSlabs(DT dt, const BvhView& bvh, const Vec3T<V>& org, const Vec3T<V>& dir) {
  const V farthest = MaxComponent(Abs(org));
  const V reach = hn::Add(farthest, hn::Set(dt, bvh.max_abs_coord));
  const V limit = hn::Div(hn::Set(dt, 0x1p125f), hn::Max(reach, hn::Set(dt, 0x1p29f)));
  const V one = hn::Set(dt, 1.0f);
  const Vec3T<V> inv = {LimitedInverse(one, dir.x, limit), LimitedInverse(one, dir.y, limit),
                        LimitedInverse(one, dir.z, limit)};
  const Vec3T<V> bias = Neg(Mul(org, inv));
  const Vec3T<V> margin = Scale(hn::Mul(farthest, hn::Set(dt, kBoxMargin)), Abs(inv));
  return {inv, Sub(bias, margin), Add(bias, margin)};
}

// The dominant axis of directions; neither: z.
template <class M> struct DominantAxis { M is_x, is_y; };

template <class V> HWY_INLINE auto DominantAxisOf(const Vec3T<V>& dir) {
  const Vec3T<V> size = Abs(dir);
  const auto is_x = hn::And(hn::Ge(size.x, size.y), hn::Ge(size.x, size.z));
  using M = decltype(hn::Ge(size.x, size.y));
  return DominantAxis<M>{is_x, hn::AndNot(is_x, hn::Ge(size.y, size.z))};
}

template <class M, class V>
HWY_INLINE V Permute(const DominantAxis<M>& axis, V if_x, V if_y, V if_z) {
  return hn::IfThenElse(axis.is_x, if_x, hn::IfThenElse(axis.is_y, if_y, if_z));
}

template <class DT, class M, class V = hn::Vec<DT>>
HWY_INLINE ShearRay<V> MakeShear(DT dt, const DominantAxis<M>& axis, const Vec3T<V>& org,
                                 const Vec3T<V>& dir) {
  const V dir_z = Permute(axis, dir.x, dir.y, dir.z);
  return {Permute(axis, org.y, org.z, org.x),
          Permute(axis, org.z, org.x, org.y),
          Permute(axis, org.x, org.y, org.z),
          hn::Div(Permute(axis, dir.y, dir.z, dir.x), dir_z),
          hn::Div(Permute(axis, dir.z, dir.x, dir.y), dir_z),
          hn::Div(hn::Set(dt, 1.0f), dir_z)};
}

// ---------------------------------------------------------------- instances
// A ray in the space of an instance's object. The direction keeps its length, so that t means the
// same in both spaces.
//
// Why every traversal finds the same hit: as in triangle-inl.h, with the instance's own box as one
// more box above its primitives. A hit is no nearer than the computed entry into that box, which
// all boxes above it contain exactly; a ray that misses the box has no hit in the instance.
//
// The ray's own rounding here is not covered by any box: with r = 2^-24, the point is off by at
// most 4 r |to_object| |org - centre|, the direction by 3 r |to_object| |dir|. So a mesh is
// watertight within an instance, since all its triangles see one ray, but not between two
// instances.
template <class DT, class V = hn::Vec<DT>>
HWY_INLINE void MoveToObject(DT dt, const InstanceRecord& instance, Vec3T<V>& org, Vec3T<V>& dir) {
  const float* m = instance.to_object;
  const float* c = instance.centre;
  const Rows<V> rows = {{hn::Set(dt, m[0]), hn::Set(dt, m[1]), hn::Set(dt, m[2])},
                        {hn::Set(dt, m[3]), hn::Set(dt, m[4]), hn::Set(dt, m[5])},
                        {hn::Set(dt, m[6]), hn::Set(dt, m[7]), hn::Set(dt, m[8])}};
  const Vec3T<V> from = Sub(org, {hn::Set(dt, c[0]), hn::Set(dt, c[1]), hn::Set(dt, c[2])});
  org = {Dot(rows.x, from), Dot(rows.y, from), Dot(rows.z, from)};
  dir = {Dot(rows.x, dir), Dot(rows.y, dir), Dot(rows.z, dir)};
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_RAY_SETUP_INL_H_
