// Rays and a tree in, the closest hit of every ray out.
#include "kernels/intersect_rays.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/intersect_rays.cc"
#include <hwy/foreach_target.h>

#include "kernels/traverse-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

struct WriteHits {
  const HitsOut& hits;

  HWY_INLINE void operator()(size_t row, const SingleHit& best) const {
    hits.t[row] = best.prim == kNoPrim ? hn::GetLane(InfinityOf(D())) : best.t;
    hits.prim[row] = best.prim;
    hits.u[row] = best.u;
    hits.v[row] = best.v;
    hits.instance[row] = best.instance;
  }
  HWY_INLINE void operator()(const uint32_t* rows, uint64_t lanes, const LaneHits& best) const {
    for (; lanes != 0; lanes &= lanes - 1) {
      const size_t i = hwy::Num0BitsBelowLS1Bit_Nonzero64(lanes);
      (*this)(rows[i], best.Get(i));
    }
  }
  HWY_INLINE void operator()(size_t row, const LaneHits& best) const {
    const U32 prim = hn::Load(DU(), best.prim);
    const Mask none = ToFloatMask(hn::Eq(prim, SetU(kNoPrim)));
    Store(hn::IfThenElse(none, InfinityOf(D()), hn::Load(D(), best.t)), hits.t, row);
    Store(prim, hits.prim, row);
    Store(hn::Load(D(), best.u), hits.u, row);
    Store(hn::Load(D(), best.v), hits.v, row);
    Store(hn::Load(DU(), best.instance), hits.instance, row);
  }
};

LaneUse IntersectRays(const BvhView& bvh, Traversal traversal, const Vec3Fields<In>& org,
                      const Vec3Fields<In>& dir, const HitsOut& hits, size_t count) {
  const RayColumns in = {org, dir, nullptr, count};
  return Traverse<false>(bvh, in, traversal, WriteHits{hits});
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
