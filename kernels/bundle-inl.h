// Packets of coherent rays in, the bounds of all their rays out: intervals of origins, of inverse
// directions and of slopes.
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

// Bounds of the rays of a bundle, all of one octant.
struct BundleBounds {
  RayPlanes planes;
  // A plane at p is entered not before (sign p - near) and left not after (sign p - far), each
  // times what of [least, most] makes the interval wide.
  float sign[3], near[3], far[3], least[3], most[3];
  float org_extent;  // the largest of the origins' box

  bool one_axis;  // all rays have the same dominant axis; only then the rest is there
  VertexColumns columns;
  // Of the origins and of the slopes in the columns' order: middle and half of the extent.
  float org[3], org_half[3], slope[2], slope_half[2];
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

// Of the rays that have not ended: origins and inverse directions in x, y, z. After the origins
// follows the first slope, after the inverse directions the second.
struct RayIntervals {
  float org_least[4], org_most[4], inv_least[4], inv_most[4];
};

// kAll: no ray has ended; else `active` has those of each packet that have not. A slope that is
// NaN, of a ray without direction, is dropped: Min drops its first operand.
template <bool kAll>
HWY_INLINE void FindIntervals(const Bundle& bundle, const Mask* active, RayIntervals& of) {
  const F32 top = InfinityOf(D());
  F32 least[8], most[8];
  for (size_t k = 0; k < 8; ++k) {
    least[k] = top;
    most[k] = top;  // of the negated values
  }
  for (size_t p = 0; p < bundle.packets; ++p) {
    const PacketRays& rays = bundle.rays[p];
    const F32 values[8] = {rays.org.x,         rays.org.y,        rays.org.z,
                           rays.shear.shear_x, rays.slabs.inv.x,  rays.slabs.inv.y,
                           rays.slabs.inv.z,   rays.shear.shear_y};
    for (size_t k = 0; k < 8; ++k) {
      const F32 negated = hn::Neg(values[k]);
      least[k] = hn::Min(kAll ? values[k] : hn::IfThenElse(active[p], values[k], top), least[k]);
      most[k] = hn::Min(kAll ? negated : hn::IfThenElse(active[p], negated, top), most[k]);
    }
  }
  StoreLeast(least[0], least[1], least[2], least[3], of.org_least);
  StoreLeast(most[0], most[1], most[2], most[3], of.org_most);
  StoreLeast(least[4], least[5], least[6], least[7], of.inv_least);
  StoreLeast(most[4], most[5], most[6], most[7], of.inv_most);
  for (size_t k = 0; k < 4; ++k) {
    of.org_most[k] = -of.org_most[k];
    of.inv_most[k] = -of.inv_most[k];
  }
}

// What CrossChildren asks.
HWY_INLINE void BoundPlanes(const RayIntervals& of, BundleBounds& bounds) {
  float farthest = 0.0f;
  uint32_t octant = 0;
  bounds.org_extent = 0.0f;
  for (uint32_t k = 0; k < 3; ++k) {
    farthest = HWY_MAX(farthest, HWY_MAX(-of.org_least[k], of.org_most[k]));
    bounds.org_extent = HWY_MAX(bounds.org_extent, of.org_most[k] - of.org_least[k]);
    octant |= (std::signbit(of.inv_least[k]) ? 1u : 0u) << k;
  }
  bounds.planes = kRayPlanes[octant];
  const float margin = kBundleMargin * farthest;
  for (uint32_t k = 0; k < 3; ++k) {
    const bool negative = ((octant >> k) & 1) != 0;
    bounds.sign[k] = negative ? -1.0f : 1.0f;
    bounds.near[k] = (negative ? -of.org_least[k] : of.org_most[k]) + margin;
    bounds.far[k] = (negative ? -of.org_most[k] : of.org_least[k]) - margin;
    bounds.least[k] = negative ? -of.inv_most[k] : of.inv_least[k];
    bounds.most[k] = negative ? -of.inv_least[k] : of.inv_most[k];
  }
}

// What CrossTriangles asks.
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
  if (!bounds.one_axis) return;

  const uint32_t axis = is_x != 0 ? 0 : is_y != 0 ? 1 : 2;
  bounds.columns = kVertexColumns[axis];
  for (uint32_t k = 0; k < 3; ++k) {
    const uint32_t from = (axis + 1 + k) % 3;  // the dominant one comes last
    MiddleOf(of.org_least[from], of.org_most[from], bounds.org[k], bounds.org_half[k]);
  }
  MiddleOf(of.org_least[3], of.org_most[3], bounds.slope[0], bounds.slope_half[0]);
  MiddleOf(of.inv_least[3], of.inv_most[3], bounds.slope[1], bounds.slope_half[1]);
}

// Finds the bounds of the rays that have not ended. False if there are none. All are of one octant.
HWY_INLINE bool BoundBundle(Bundle& bundle) {
  Mask active[kBundlePackets];
  bool any = false, all = true;
  for (size_t p = 0; p < bundle.packets; ++p) {
    active[p] = hn::Ge(bundle.rays[p].t, hn::Zero(D()));
    any |= !hn::AllFalse(D(), active[p]);
    all &= hn::AllTrue(D(), active[p]);
  }
  if (!any) return false;
  RayIntervals intervals;
  if (all) {
    FindIntervals<true>(bundle, active, intervals);
  } else {
    FindIntervals<false>(bundle, active, intervals);
  }
  BoundPlanes(intervals, bundle.bounds);
  BoundSlopes(intervals, bundle, active, bundle.bounds);
  return true;
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SWELL_KERNELS_BUNDLE_INL_H_
