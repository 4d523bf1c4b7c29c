// Shadow rays and a tree in; the paths whose ray is free gain its radiance.
#include "kernels/occlude_rays.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/occlude_rays.cc"
#include <hwy/foreach_target.h>

#include "kernels/traverse_single-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

HWY_INLINE LaneUse OccludePackets(const BvhView& bvh, const RayColumns& in,
                                  const ShadowRaysIn& shadow, const RgbFields<Out>& path_radiance) {
  LaneUse use;
  for (size_t row = 0; row < in.count; row += hn::Lanes(D())) {
    PacketRays rays = SetUpRays(bvh, in, row);

    TracePacket<true>(bvh, rays, use);

    const Mask free = ToFloatMask(hn::Eq(rays.prim, SetU(kNoPrim)));
    AddToPaths(hn::And(free, FirstLanes(in.count - row)), Load(shadow.radiance, row), path_radiance,
               Load(shadow.path, row));
  }
  return use;
}

HWY_INLINE LaneUse OccludeSingle(const BvhView& bvh, const RayColumns& in,
                                 const ShadowRaysIn& shadow, const RgbFields<Out>& path_radiance) {
  return TraceSingle<true>(bvh, in, [&](size_t row, const SingleHit& best) {
    if (best.prim != kNoPrim) return;
    const uint32_t path = shadow.path[row];
    path_radiance.r[path] += shadow.radiance.r[row];
    path_radiance.g[path] += shadow.radiance.g[row];
    path_radiance.b[path] += shadow.radiance.b[row];
  });
}

LaneUse OccludeRays(const BvhView& bvh, Traversal traversal, const ShadowRaysIn& shadow,
                    const RgbFields<Out>& path_radiance, size_t count) {
  const RayColumns in = {shadow.org, shadow.dir, shadow.t_max, count};
  if (ChoosePacket(bvh, traversal)) return OccludePackets(bvh, in, shadow, path_radiance);
  return OccludeSingle(bvh, in, shadow, path_radiance);
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
