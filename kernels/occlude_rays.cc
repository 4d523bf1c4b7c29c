// Shadow rays and a tree in; the paths whose ray is free gain its radiance.
#include "kernels/occlude_rays.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/occlude_rays.cc"
#include <hwy/foreach_target.h>

#include "kernels/traverse-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

struct AddFree {
  const ShadowRaysIn& shadow;
  const RgbFields<Out>& radiance;

  HWY_INLINE void operator()(size_t row, const SingleHit& best) const {
    if (best.prim != kNoPrim) return;
    const uint32_t path = shadow.path[row];
    radiance.r[path] += shadow.radiance.r[row];
    radiance.g[path] += shadow.radiance.g[row];
    radiance.b[path] += shadow.radiance.b[row];
  }
  // All lanes are rows, so their paths are this call's own: columns of them may be stored whole.
  HWY_INLINE void operator()(size_t row, const LaneHits& best) const {
    const Mask free = ToFloatMask(hn::Eq(hn::Load(DU(), best.prim), SetU(kNoPrim)));
    const Rgb gained = Load(shadow.radiance, row);
    const U32 path = Load(shadow.path, row);
    const uint32_t first = shadow.path[row];
    if (hn::AllTrue(DU(), hn::Eq(path, CountFrom(first)))) {  // as where one material was shaded
      AddInTurn(free, gained.r, radiance.r + first);
      AddInTurn(free, gained.g, radiance.g + first);
      AddInTurn(free, gained.b, radiance.b + first);
    } else {
      AddToPaths(free, gained, radiance, path);
    }
  }
  static HWY_INLINE void AddInTurn(Mask mask, F32 gained, float* column) {
    const F32 before = Load(column, 0);
    Store(hn::IfThenElse(mask, hn::Add(before, gained), before), column, 0);
  }
};

LaneUse OccludeRays(const BvhView& bvh, Traversal traversal, const ShadowRaysIn& shadow,
                    const RgbFields<Out>& path_radiance, size_t count) {
  const RayColumns in = {shadow.org, shadow.dir, shadow.t_max, count};
  return Traverse<true>(bvh, in, traversal, AddFree{shadow, path_radiance});
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
