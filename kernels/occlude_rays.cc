// Shadow rays and a tree in; the paths whose ray is free gain its radiance.
#include "kernels/occlude_rays.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/occlude_rays.cc"
#include <hwy/foreach_target.h>

#include "kernels/traverse-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

LaneUse OccludeRays(const BvhView& bvh, Traversal traversal, const ShadowRaysIn& shadow,
                    const RgbFields<Out>& path_radiance, size_t count) {
  const RayColumns in = {shadow.org, shadow.dir, shadow.t_max, count};
  return Traverse<true>(bvh, in, traversal, [&](size_t row, const SingleHit& best) {
    if (best.prim != kNoPrim) return;
    const uint32_t path = shadow.path[row];
    path_radiance.r[path] += shadow.radiance.r[row];
    path_radiance.g[path] += shadow.radiance.g[row];
    path_radiance.b[path] += shadow.radiance.b[row];
  });
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
