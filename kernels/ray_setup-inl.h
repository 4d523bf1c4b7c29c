// Rays in columns in, vectors of rays ready for traversal out.
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

// The dominant axis of directions; neither: z.
template <class M> struct DominantAxis { M is_x, is_y; };

// The rows a call traces. t_max is null for closest hits.
struct RayColumns {
  Vec3Fields<In> org, dir;
  const float* t_max;
  size_t count;
};

// A vector of rays, ready for traversal.
struct PacketRays {
  Vec3 org, dir;
  Slabs<F32> slabs;
  ShearRay<F32> shear;
  Mask negative_x, negative_y, negative_z;  // signs of slabs.inv
  DominantAxis<Mask> axis;
  uint32_t inside;  // the instance in whose space the rays are; kNone: the world
  F32 enter;        // where they enter it, no hit in it is nearer; in the world 0
  F32 t;  // no hit beyond this counts (closest: at this counts); below zero: the ray has ended
};

// Bit i is lane i.
template <class DT> HWY_INLINE uint32_t MaskBits(DT dt, hn::Mask<DT> mask) {
  static_assert(hn::MaxLanes(DT()) <= 16, "two bytes");
  uint64_t bits = 0;  // little-endian, as all targets are
  hn::StoreMaskBits(dt, mask, reinterpret_cast<uint8_t*>(&bits));
  return static_cast<uint32_t>(bits);
}

// Octants of directions or of their inverses, as in BvhNode::order: the signs, of zeros too.
HWY_INLINE U32 OctantOf(const Vec3& dir) {
  const U32 x = hn::ShiftRight<31>(Bits(dir.x));
  const U32 y = hn::ShiftRight<31>(Bits(dir.y));
  const U32 z = hn::ShiftRight<31>(Bits(dir.z));
  return hn::Or(x, hn::Or(hn::ShiftLeft<1>(y), hn::ShiftLeft<2>(z)));
}

template <class DT, class V = hn::Vec<DT>>
HWY_INLINE hn::Mask<DT> IsFinite(DT dt, const Vec3T<V>& org, const Vec3T<V>& dir) {
  const V most = hn::Set(dt, kMostFinite);
  const Vec3T<V> o = Abs(org), d = Abs(dir);
  return hn::And(hn::And(hn::And(hn::Le(o.x, most), hn::Le(o.y, most)),
                         hn::And(hn::Le(o.z, most), hn::Le(d.x, most))),
                 hn::And(hn::Le(d.y, most), hn::Le(d.z, most)));
}

template <class V> HWY_INLINE V LimitTo(V limit, V v) {
  return hn::CopySign(hn::Min(hn::Abs(v), limit), v);
}

template <class DT, class V = hn::Vec<DT>> HWY_INLINE Vec3T<V> Inverse(DT dt, const Vec3T<V>& dir) {
  const V one = hn::Set(dt, 1.0f);
  return {hn::Div(one, dir.x), hn::Div(one, dir.y), hn::Div(one, dir.z)};
}

// inv: Inverse of the direction.
template <class DT, class V = hn::Vec<DT>>
HWY_INLINE Slabs<V> MakeSlabs(DT dt, const BvhView& bvh, const Vec3T<V>& org, Vec3T<V> inv) {
  const V farthest = MaxComponent(Abs(org));
  const V reach = hn::Add(farthest, hn::Set(dt, bvh.max_abs_coord));
  const V widest = hn::Max(reach, hn::Set(dt, 0x1p29f));
  // So that no slab's distance overflows. Rarely is any inverse near that.
  const V product = hn::Mul(MaxComponent(Abs(inv)), widest);
  if (!hn::AllTrue(dt, hn::Lt(product, hn::Set(dt, 0x1p124f)))) {
    const V limit = hn::Div(hn::Set(dt, 0x1p125f), widest);
    inv = {LimitTo(limit, inv.x), LimitTo(limit, inv.y), LimitTo(limit, inv.z)};
  }
  const Vec3T<V> bias = Neg(Mul(org, inv));
  const Vec3T<V> margin = Scale(hn::Mul(farthest, hn::Set(dt, kBoxMargin)), Abs(inv));
  return {inv, Sub(bias, margin), Add(bias, margin)};
}

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

// inv: Inverse of the direction.
template <class M, class V>
HWY_INLINE ShearRay<V> MakeShear(const DominantAxis<M>& axis, const Vec3T<V>& org,
                                 const Vec3T<V>& dir, const Vec3T<V>& inv) {
  const V dir_z = Permute(axis, dir.x, dir.y, dir.z);
  return {Permute(axis, org.y, org.z, org.x),
          Permute(axis, org.z, org.x, org.y),
          Permute(axis, org.x, org.y, org.z),
          hn::Div(Permute(axis, dir.y, dir.z, dir.x), dir_z),
          hn::Div(Permute(axis, dir.z, dir.x, dir.y), dir_z),
          Permute(axis, inv.x, inv.y, inv.z)};
}

HWY_INLINE void SetUpSpace(const BvhView& bvh, PacketRays& rays) {
  const Vec3 inv = Inverse(D(), rays.dir);
  rays.slabs = MakeSlabs(D(), bvh, rays.org, inv);
  rays.negative_x = hn::Lt(rays.slabs.inv.x, hn::Zero(D()));
  rays.negative_y = hn::Lt(rays.slabs.inv.y, hn::Zero(D()));
  rays.negative_z = hn::Lt(rays.slabs.inv.z, hn::Zero(D()));
  rays.axis = DominantAxisOf(rays.dir);
  rays.shear = MakeShear(rays.axis, rays.org, rays.dir, inv);
}

// The rows of all lanes; those from `count` on and rays that are not finite have ended.
HWY_INLINE void SetUpRays(const BvhView& bvh, const RayColumns& in, const RowLanes& rows,
                          size_t count, PacketRays& rays) {
  rays.org = rows.Of(in.org);
  rays.dir = rows.Of(in.dir);
  SetUpSpace(bvh, rays);
  rays.inside = kNone;
  rays.enter = hn::Zero(D());

  const Mask finite = hn::And(IsFinite(D(), rays.org, rays.dir), FirstLanes(count));
  // A hit at infinity is none: the closest hit starts just below it.
  const F32 t = in.t_max == nullptr ? Set(kMostFinite) : rows.Of(in.t_max);
  rays.t = hn::IfThenElse(hn::And(finite, hn::Ge(t, hn::Zero(D()))), t, Set(-1.0f));
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_RAY_SETUP_INL_H_
