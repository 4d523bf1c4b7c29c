// Rays and a tree in, the closest hit of every ray out.
#include "kernels/intersect_rays.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/intersect_rays.cc"
#include <hwy/foreach_target.h>

#include "kernels/traverse_single-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

HWY_INLINE LaneUse IntersectPackets(const BvhView& bvh, const RayColumns& in, const HitsOut& hits) {
  LaneUse use;
  for (size_t row = 0; row < in.count; row += hn::Lanes(D())) {
    PacketRays rays = SetUpRays(bvh, in, row);

    TracePacket<false>(bvh, rays, use);

    const Mask hit = ToFloatMask(hn::Ne(rays.prim, SetU(kNoPrim)));
    Store(hn::IfThenElse(hit, rays.t, InfinityOf(D())), hits.t, row);
    Store(rays.prim, hits.prim, row);
    Store(hn::Div(rays.u, rays.weights), hits.u, row);
    Store(hn::Div(rays.v, rays.weights), hits.v, row);
    Store(rays.instance, hits.instance, row);
  }
  return use;
}

HWY_INLINE LaneUse IntersectSingle(const BvhView& bvh, const RayColumns& in, const HitsOut& hits) {
  const float infinity = hn::GetLane(InfinityOf(D()));
  return TraceSingle<false>(bvh, in, [&](size_t row, const SingleHit& best) {
    hits.t[row] = best.prim == kNoPrim ? infinity : best.t;
    hits.prim[row] = best.prim;
    hits.u[row] = best.u;
    hits.v[row] = best.v;
    hits.instance[row] = best.instance;
  });
}

LaneUse IntersectRays(const BvhView& bvh, Traversal traversal, const Vec3Fields<In>& org,
                      const Vec3Fields<In>& dir, const HitsOut& hits, size_t count) {
  const RayColumns in = {org, dir, nullptr, count};
  if (ChoosePacket(bvh, traversal)) return IntersectPackets(bvh, in, hits);
  return IntersectSingle(bvh, in, hits);
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::SWELL_WIDTH {

HWY_EXPORT(IntersectRays);

LaneUse IntersectRays(const BvhView& bvh, Traversal traversal, const Vec3Fields<In>& org,
                      const Vec3Fields<In>& dir, const HitsOut& hits, size_t count) {
  return HWY_DYNAMIC_DISPATCH(IntersectRays)(bvh, traversal, org, dir, hits, count);
}

}  // namespace swell::SWELL_WIDTH
#endif
