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
  Mask z_is_x, z_is_y;                      // the dominant axis; neither: z
  F32 t;  // no hit beyond this counts (closest: at this counts); below zero: the ray has ended
};

// Bit i is lane i.
template <class DT> HWY_INLINE uint32_t MaskBits(DT dt, hn::Mask<DT> mask) {
  static_assert(hn::MaxLanes(DT()) <= 16, "two bytes");
  uint8_t bytes[8] = {0};
  hn::StoreMaskBits(dt, mask, bytes);
  return bytes[0] | uint32_t{bytes[1]} << 8;
}

// Octants of directions, as in BvhNode::order.
HWY_INLINE U32 OctantOf(const Vec3& dir) {
  const auto bit = [](F32 v, uint32_t value) {
    return hn::IfThenElseZero(ToUintMask(hn::Lt(v, hn::Zero(D()))), SetU(value));
  };
  return hn::Or(bit(dir.x, 1), hn::Or(bit(dir.y, 2), bit(dir.z, 4)));
}

// The largest 1 / |dir| that cannot overflow a slab's distance.
HWY_INLINE F32 InverseLimit(F32 reach) {
  return hn::Div(Set(0x1p125f), hn::Max(reach, Set(0x1p29f)));
}

HWY_INLINE F32 LimitedInverse(F32 dir, F32 limit) {
  return hn::CopySign(hn::Min(hn::Abs(hn::Div(Set(1.0f), dir)), limit), dir);
}

HWY_INLINE F32 Permute(const PacketRays& rays, F32 if_x, F32 if_y, F32 if_z) {
  return hn::IfThenElse(rays.z_is_x, if_x, hn::IfThenElse(rays.z_is_y, if_y, if_z));
}

HWY_INLINE void SetUpSlabs(const BvhView& bvh, PacketRays& rays) {
  const Vec3 abs_org = Abs(rays.org);
  const F32 farthest = hn::Max(abs_org.x, hn::Max(abs_org.y, abs_org.z));
  const F32 limit = InverseLimit(hn::Add(farthest, Set(bvh.max_abs_coord)));
  const Vec3 inv = {LimitedInverse(rays.dir.x, limit), LimitedInverse(rays.dir.y, limit),
                    LimitedInverse(rays.dir.z, limit)};
  const Vec3 bias = Neg(Mul(rays.org, inv));
  const Vec3 margin = Scale(hn::Mul(farthest, Set(kBoxMargin)), Abs(inv));
  rays.slabs = {inv, Sub(bias, margin), Add(bias, margin)};
  rays.negative_x = hn::Lt(inv.x, hn::Zero(D()));
  rays.negative_y = hn::Lt(inv.y, hn::Zero(D()));
  rays.negative_z = hn::Lt(inv.z, hn::Zero(D()));
}

HWY_INLINE void SetUpShear(PacketRays& rays) {
  const Vec3 dir = Abs(rays.dir);
  rays.z_is_x = hn::And(hn::Ge(dir.x, dir.y), hn::Ge(dir.x, dir.z));
  rays.z_is_y = AndNot(rays.z_is_x, hn::Ge(dir.y, dir.z));
  const F32 dir_z = Permute(rays, rays.dir.x, rays.dir.y, rays.dir.z);
  rays.shear = {Permute(rays, rays.org.y, rays.org.z, rays.org.x),
                Permute(rays, rays.org.z, rays.org.x, rays.org.y),
                Permute(rays, rays.org.x, rays.org.y, rays.org.z),
                hn::Div(Permute(rays, rays.dir.y, rays.dir.z, rays.dir.x), dir_z),
                hn::Div(Permute(rays, rays.dir.z, rays.dir.x, rays.dir.y), dir_z),
                hn::Div(Set(1.0f), dir_z)};
}

// The rows of all lanes; those from `count` on and rays that are not finite have ended.
HWY_INLINE PacketRays SetUpRays(const BvhView& bvh, const RayColumns& in, U32 rows, size_t count) {
  PacketRays rays;
  rays.org = Gather(in.org, rows);
  rays.dir = Gather(in.dir, rows);
  SetUpSlabs(bvh, rays);
  SetUpShear(rays);

  const F32 most = Set(0x1.fffffep127f);
  const Vec3 org = Abs(rays.org), dir = Abs(rays.dir);
  const Mask finite =
      hn::And(hn::And(hn::And(hn::Le(org.x, most), hn::Le(org.y, most)),
                      hn::And(hn::Le(org.z, most), hn::Le(dir.x, most))),
              hn::And(hn::And(hn::Le(dir.y, most), hn::Le(dir.z, most)), FirstLanes(count)));
  // A hit at infinity is none: the closest hit starts just below it.
  const F32 t = in.t_max == nullptr ? most : Gather(in.t_max, rows);
  rays.t = hn::IfThenElse(hn::And(finite, hn::Ge(t, hn::Zero(D()))), t, Set(-1.0f));
  return rays;
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_RAY_SETUP_INL_H_
