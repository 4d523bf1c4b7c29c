// Packets of coherent rays in, the bounds of all their rays out: intervals of origins, of inverse
// directions, of slopes and of ends.
#if defined(SWELL_KERNELS_BUNDLE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_KERNELS_BUNDLE_INL_H_
#undef SWELL_KERNELS_BUNDLE_INL_H_
#else
#define SWELL_KERNELS_BUNDLE_INL_H_
#endif

#include <cmath>

#include "kernels/visit_single-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

inline constexpr size_t kBundleRays = 64;
inline constexpr size_t kBundlePackets = HWY_MAX(kBundleRays / kPacketRows, 1);

inline constexpr float kBundleMargin = 1.25f * kBoxMargin;
inline constexpr float kWiden = 0x1p-20f;

// Slopes of a bundle are at most this: 4 and 8 were alike (Cornell box, AVX-512).
inline constexpr float kSteepest = 4.0f;

// Bounds of the rays of a bundle, all of one octant.
struct BundleBounds {
  RayPlanes planes;
  // A plane at p is entered not before (sign p - near) and left not after (sign p - far), each
  // times what of [least, most] makes the interval wide.
  float sign[3], near[3], far[3], least[3], most[3];
  float org_extent;  // the largest of the origins' box

  bool one_axis;     // all rays have the same dominant axis
  bool have_slopes;  // along `axis`, the rays' dominant one or near it; only then the rest is there
  uint32_t axis;
  VertexColumns columns;  // of the axis
  // Of the origins and of the slopes in the columns' order: middle and half of the extent.
  float org[3], org_half[3], slope[2], slope_half[2];
  float behind;    // a vertex at z along the axis is behind all rays if sign z is at most this
  bool have_ends;  // all end, before infinity
  float end[3], end_half[3];
};

// Up to kBundleRays rays of one octant; those of the last packet may have ended before they begin.
struct Bundle {
  PacketRays rays[kBundlePackets];
  LaneHits best[kBundlePackets];
  size_t packets;
  BundleBounds bounds;
};

// Middle and half of an interval; the half is rounded up.
HWY_INLINE void MiddleOf(float least, float most, float& middle, float& half) {
  middle = 0.5f * least + 0.5f * most;
  half = HWY_MAX(most - middle, middle - least) * (1.0f + kWiden);
}

struct Range4 {
  float least[4], most[4];
};

// Middle and half of x, y and z, in the order of the columns of an axis, which comes last.
HWY_INLINE void MiddlesOf(const Range4& range, uint32_t axis, float (&middle)[3],
                          float (&half)[3]) {
  for (uint32_t k = 0; k < 3; ++k) {
    const uint32_t from = (axis + 1 + k) % 3;
    MiddleOf(range.least[from], range.most[from], middle[k], half[k]);
  }
}

// The least lane of each of four vectors.
HWY_INLINE void StoreLeast(F32 a, F32 b, F32 c, F32 d, float (&least)[4]) {
#if defined(SWELL_ONE_LANE) || HWY_TARGET == HWY_SCALAR
  const F32 all[4] = {a, b, c, d};
  for (size_t i = 0; i < 4; ++i) least[i] = hn::GetLane(all[i]);
#else
  const hn::Repartition<double, D> d64;
  const F32 ab = hn::Min(hn::InterleaveLower(D(), a, b), hn::InterleaveUpper(D(), a, b));
  const F32 cd = hn::Min(hn::InterleaveLower(D(), c, d), hn::InterleaveUpper(D(), c, d));
  const auto ab64 = hn::BitCast(d64, ab), cd64 = hn::BitCast(d64, cd);
  alignas(64) float blocks[kPacketRows];
  hn::Store(hn::Min(hn::BitCast(D(), hn::InterleaveLower(d64, ab64, cd64)),
                    hn::BitCast(D(), hn::InterleaveUpper(d64, ab64, cd64))),
            D(), blocks);
  const hn::FixedTag<float, 4> d4;
  auto v = hn::Load(d4, blocks);
  for (size_t i = 4; i < kPacketRows; i += 4) v = hn::Min(v, hn::Load(d4, blocks + i));
  hn::StoreU(v, d4, least);
#endif
}

// Of four values of each ray that has not ended: values(rays, v). kAll: none has; else `active` has
// those of each packet that have not. A value that is NaN, such as a slope of a ray without
// direction, is dropped: Min drops its first operand.
template <bool kAll, class Values>
HWY_INLINE void FindRange(const Bundle& bundle, const Mask* active, const Values& values,
                          Range4& range) {
  const F32 top = InfinityOf(D());
  F32 least[4], most[4];  // most: of the negated values
  for (size_t k = 0; k < 4; ++k) least[k] = most[k] = top;
  for (size_t p = 0; p < bundle.packets; ++p) {
    F32 v[4];
    values(bundle.rays[p], v);
    for (size_t k = 0; k < 4; ++k) {
      const F32 negated = hn::Neg(v[k]);
      least[k] = hn::Min(kAll ? v[k] : hn::IfThenElse(active[p], v[k], top), least[k]);
      most[k] = hn::Min(kAll ? negated : hn::IfThenElse(active[p], negated, top), most[k]);
    }
  }
  StoreLeast(least[0], least[1], least[2], least[3], range.least);
  StoreLeast(most[0], most[1], most[2], most[3], range.most);
  for (float& value : range.most) value = -value;
}

// Origins and inverse directions in x, y, z. After the origins follows the first slope, after the
// inverse directions the second.
struct RayIntervals {
  Range4 org, inv;
};

// What CrossChildren asks.
HWY_INLINE void BoundPlanes(const RayIntervals& of, BundleBounds& bounds) {
  float farthest = 0.0f;
  uint32_t octant = 0;
  bounds.org_extent = 0.0f;
  for (uint32_t k = 0; k < 3; ++k) {
    farthest = HWY_MAX(farthest, HWY_MAX(-of.org.least[k], of.org.most[k]));
    bounds.org_extent = HWY_MAX(bounds.org_extent, of.org.most[k] - of.org.least[k]);
    octant |= (std::signbit(of.inv.least[k]) ? 1u : 0u) << k;
  }
  bounds.planes = kRayPlanes[octant];
  const float margin = kBundleMargin * farthest;
  for (uint32_t k = 0; k < 3; ++k) {
    const bool negative = ((octant >> k) & 1) != 0;
    bounds.sign[k] = negative ? -1.0f : 1.0f;
    bounds.near[k] = (negative ? -of.org.least[k] : of.org.most[k]) + margin;
    bounds.far[k] = (negative ? -of.org.most[k] : of.org.least[k]) - margin;
    bounds.least[k] = negative ? -of.inv.most[k] : of.inv.least[k];
    bounds.most[k] = negative ? -of.inv.least[k] : of.inv.most[k];
  }
}

// Of absolute values: the greatest in an axis, the least in any.
HWY_INLINE float MostInverse(const RayIntervals& of, uint32_t k) {
  return HWY_MAX(-of.inv.least[k], of.inv.most[k]);
}
HWY_INLINE float LeastInverse(const RayIntervals& of) {
  float least = HUGE_VALF;
  for (uint32_t k = 0; k < 3; ++k) {
    least = HWY_MIN(least, HWY_MAX(of.inv.least[k], -of.inv.most[k]));
  }
  return least;
}

// Where the dominant axes differ: slopes along the axis in which the least direction is greatest;
// infinite where they could be steep.
template <bool kAll>
HWY_INLINE uint32_t FindSlopes(const RayIntervals& of, const Bundle& bundle, const Mask* active,
                               Range4& slopes) {
  uint32_t axis = 0;
  for (uint32_t k = 1; k < 3; ++k) {
    if (MostInverse(of, k) < MostInverse(of, axis)) axis = k;
  }
  slopes.most[0] = HUGE_VALF;
  if (MostInverse(of, axis) > kSteepest * LeastInverse(of)) return axis;
  const auto slopes_of = [&](const PacketRays& rays, F32(&v)[4]) HWY_ATTR {
    const Vec3& d = rays.dir;
    const F32 z = axis == 0 ? d.x : axis == 1 ? d.y : d.z;
    v[0] = v[2] = hn::Div(axis == 0 ? d.y : axis == 1 ? d.z : d.x, z);
    v[1] = v[3] = hn::Div(axis == 0 ? d.z : axis == 1 ? d.x : d.y, z);
  };
  FindRange<kAll>(bundle, active, slopes_of, slopes);
  return axis;
}

// What CrossTriangles asks.
template <bool kAll>
HWY_INLINE void BoundSlopes(const RayIntervals& of, const Bundle& bundle, const Mask* active,
                            BundleBounds& bounds) {
  uint32_t is_x = 0, is_y = 0, is_z = 0;  // lanes of any packet
  for (size_t p = 0; p < bundle.packets; ++p) {
    const DominantAxis<Mask>& axis = bundle.rays[p].axis;
    is_x |= MaskBits(D(), hn::And(active[p], axis.is_x));
    is_y |= MaskBits(D(), hn::And(active[p], axis.is_y));
    is_z |= MaskBits(D(), hn::AndNot(hn::Or(axis.is_x, axis.is_y), active[p]));
  }
  bounds.one_axis = (is_x != 0 ? 1 : 0) + (is_y != 0 ? 1 : 0) + (is_z != 0 ? 1 : 0) == 1;
  bounds.axis = is_x != 0 ? 0 : is_y != 0 ? 1 : 2;
  Range4 slopes = {{of.org.least[3], of.inv.least[3]}, {of.org.most[3], of.inv.most[3]}};
  if (!bounds.one_axis) bounds.axis = FindSlopes<kAll>(of, bundle, active, slopes);
  bounds.have_slopes = true;
  for (uint32_t k = 0; k < 2; ++k) {
    bounds.have_slopes &= -slopes.least[k] <= kSteepest && slopes.most[k] <= kSteepest;
    MiddleOf(slopes.least[k], slopes.most[k], bounds.slope[k], bounds.slope_half[k]);
  }
  bounds.columns = kVertexColumns[bounds.axis];
  MiddlesOf(of.org, bounds.axis, bounds.org, bounds.org_half);
  bounds.behind =
      bounds.sign[bounds.axis] < 0.0f ? -of.org.most[bounds.axis] : of.org.least[bounds.axis];
  if (!bounds.one_axis) bounds.behind = -HUGE_VALF;  // rays measure it along other axes
}

// Where the rays end. What rounding does to an end, of a product as large as end and origin
// together, is added.
template <bool kAll>
HWY_INLINE void BoundEnds(const RayIntervals& of, const Bundle& bundle, const Mask* active,
                          BundleBounds& bounds) {
  const auto ends = [](const PacketRays& rays, F32(&v)[4]) HWY_ATTR {
    const Vec3 end = MulAdd(rays.t, rays.dir, rays.org);
    v[0] = end.x;
    v[1] = end.y;
    v[2] = end.z;
    v[3] = end.z;
  };
  Range4 range;
  FindRange<kAll>(bundle, active, ends, range);
  for (uint32_t k = 0; k < 3; ++k) {
    const float of_end = HWY_MAX(-range.least[k], range.most[k]);
    const float margin = 0x1p-22f * HWY_MAX(of_end, HWY_MAX(-of.org.least[k], of.org.most[k]));
    range.least[k] -= margin;
    range.most[k] += margin;
  }
  MiddlesOf(range, bounds.axis, bounds.end, bounds.end_half);
  // The inverse of each ray's dominant direction is far from the ends of what floats hold.
  bounds.have_ends = LeastInverse(of) > 0x1p-30f && MostInverse(of, bounds.axis) < 0x1p30f;
}

template <bool kAll> HWY_INLINE void BoundRays(const Mask* active, bool end, Bundle& bundle) {
  const auto org = [](const PacketRays& rays, F32(&v)[4]) HWY_ATTR {
    v[0] = rays.org.x;
    v[1] = rays.org.y;
    v[2] = rays.org.z;
    v[3] = rays.shear.shear_x;
  };
  const auto inv = [](const PacketRays& rays, F32(&v)[4]) HWY_ATTR {
    v[0] = rays.slabs.inv.x;
    v[1] = rays.slabs.inv.y;
    v[2] = rays.slabs.inv.z;
    v[3] = rays.shear.shear_y;
  };
  RayIntervals intervals;
  FindRange<kAll>(bundle, active, org, intervals.org);
  FindRange<kAll>(bundle, active, inv, intervals.inv);
  BoundPlanes(intervals, bundle.bounds);
  BoundSlopes<kAll>(intervals, bundle, active, bundle.bounds);
  bundle.bounds.have_ends = false;
  if (end && bundle.bounds.have_slopes) BoundEnds<kAll>(intervals, bundle, active, bundle.bounds);
}

// Finds the bounds of the rays that have not ended. False if there are none. All are of one octant.
template <bool kAny> HWY_INLINE bool BoundBundle(Bundle& bundle) {
  Mask active[kBundlePackets];
  bool any = false, all = true, end = kAny;
  for (size_t p = 0; p < bundle.packets; ++p) {
    active[p] = hn::Ge(bundle.rays[p].t, hn::Zero(D()));
    any |= !hn::AllFalse(D(), active[p]);
    all &= hn::AllTrue(D(), active[p]);
    if (kAny) end &= hn::AllTrue(D(), hn::Lt(bundle.rays[p].t, InfinityOf(D())));
  }
  if (!any) return false;
  if (all) {
    BoundRays<true>(active, end, bundle);
  } else {
    BoundRays<false>(active, end, bundle);
  }
  return true;
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_BUNDLE_INL_H_
