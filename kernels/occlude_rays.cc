// Shadow rays and a tree in; the paths whose ray is free gain its radiance.
#include "kernels/occlude_rays.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/occlude_rays.cc"
#include <hwy/foreach_target.h>

#include "kernels/traverse-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

using DFlags = hn::Rebind<uint8_t, DU>;

// 1 for rows that are free. Rays end in any order and as often free as not, so no branch depends on
// which; light is added afterwards, in the order of the rows.
struct KeepFree {
  uint8_t* free;

  HWY_INLINE void operator()(size_t row, const SingleHit& best) const {
    free[row] = best.prim == kNoPrim ? 1 : 0;
  }
  HWY_INLINE void operator()(const uint32_t* rows, uint64_t lanes, const LaneHits& best) const {
    const uint32_t bits = MaskBits(DU(), IsFree(best));
    for (; lanes != 0; lanes &= lanes - 1) {
      const size_t i = hwy::Num0BitsBelowLS1Bit_Nonzero64(lanes);
      free[rows[i]] = (bits >> i) & 1;
    }
  }
  HWY_INLINE void operator()(size_t row, const LaneHits& best) const {
    const U32 flags = hn::IfThenElseZero(IsFree(best), SetU(1));
    hn::StoreU(hn::TruncateTo(DFlags(), flags), DFlags(), free + row);
  }
  static HWY_INLINE MaskU IsFree(const LaneHits& best) {
    return hn::Eq(hn::Load(DU(), best.prim), SetU(kNoPrim));
  }
};

HWY_INLINE void AddInTurn(Mask mask, F32 gained, float* column) {
  const F32 before = Load(column, 0);
  Store(hn::IfThenElse(mask, hn::Add(before, gained), before), column, 0);
}

// Rows [first, first + count), of which free[0, count) says which are free.
HWY_INLINE void AddFree(const ShadowRaysIn& shadow, size_t first, size_t count, const uint8_t* free,
                        const RgbFields<Out>& radiance) {
  for (size_t i = 0; i < count; i += hn::Lanes(D())) {
    const U32 flags = hn::PromoteTo(DU(), hn::LoadU(DFlags(), free + i));
    const Mask is_free = hn::And(ToFloatMask(hn::Ne(flags, hn::Zero(DU()))), FirstLanes(count - i));
    const Rgb gained = Load(shadow.radiance, first + i);
    const U32 path = Load(shadow.path, first + i);
    const uint32_t to = shadow.path[first + i];
    // As where one material was shaded. All lanes' paths are this call's own, so columns of them
    // may be stored whole.
    if (i + hn::Lanes(D()) <= count && hn::AllTrue(DU(), hn::Eq(path, CountFrom(to)))) {
      AddInTurn(is_free, gained.r, radiance.r + to);
      AddInTurn(is_free, gained.g, radiance.g + to);
      AddInTurn(is_free, gained.b, radiance.b + to);
    } else {
      AddToPaths(is_free, gained, radiance, path);
    }
  }
}

HWY_INLINE Vec3Fields<In> RowsFrom(const Vec3Fields<In>& columns, size_t first) {
  return {columns.x + first, columns.y + first, columns.z + first};
}

LaneUse OccludeRays(const BvhView& bvh, Traversal traversal, const ShadowRaysIn& shadow,
                    const RgbFields<Out>& path_radiance, size_t count) {
  uint8_t free[kMostSorted + kRowPadding];
  LaneUse use;
  for (size_t first = 0; first < count; first += kMostSorted) {
    const size_t rows = HWY_MIN(kMostSorted, count - first);
    const RayColumns in = {RowsFrom(shadow.org, first), RowsFrom(shadow.dir, first),
                           shadow.t_max + first, rows};
    const LaneUse part = Traverse<true>(bvh, in, traversal, KeepFree{free});
    use.active += part.active;
    use.issued += part.issued;
    AddFree(shadow, first, rows, free, path_radiance);
  }
  return use;
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::SWELL_WIDTH {

HWY_EXPORT(OccludeRays);

LaneUse OccludeRays(const BvhView& bvh, Traversal traversal, const ShadowRaysIn& shadow,
                    const RgbFields<Out>& path_radiance, size_t count) {
  return HWY_DYNAMIC_DISPATCH(OccludeRays)(bvh, traversal, shadow, path_radiance, count);
}

}  // namespace swell::SWELL_WIDTH
#endif
