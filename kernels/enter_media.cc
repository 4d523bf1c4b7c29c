// Hits and the rays that leave them -> media, by the side of the surface to which the rays go.
#include "kernels/enter_media.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/enter_media.cc"
#include <hwy/foreach_target.h>

#include "kernels/hit_surface-inl.h"
HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {

void EnterMedia(const EnterMediaArgs& args) {
  const SceneView& scene = *args.scene;
  const U32 none = SetU(kNone);
  for (size_t i = 0; i < args.count; i += hn::Lanes(D())) {
    const MaskU active = ToUintMask(FirstLanes(args.count - i));
    const auto first = static_cast<uint32_t>(i);
    const U32 key = args.path == nullptr
                        ? hn::IfThenElse(active, CountFrom(first), SetU(first))
                        : hn::IfThenElse(active, Load(args.path, i), SetU(args.path[i]));
    const U32 row = Gather(args.rows, key);
    const U32 kept = args.before == nullptr ? SetU(kKeptMedium) : Gather(args.before, key);
    Store(kept, args.after, i);

    const U32 prim = Gather(args.hits.prim, row);
    const MaskU hit = hn::And(active, hn::Ne(prim, SetU(kNoPrim)));
    if (hn::AllFalse(DU(), hit)) continue;
    const U32 shape = Gather(scene.prim_shape, hn::IfThenElseZero(hit, prim));
    const U32 inside = Gather(args.sides.inside, shape);
    const U32 outside = Gather(args.sides.outside, shape);
    const MaskU changes = hn::And(hit, hn::Ne(inside, outside));
    if (hn::AllFalse(DU(), changes)) continue;

    // Lanes that keep their medium look at the primitive of the first that does not.
    const auto leader = static_cast<size_t>(hn::FindKnownFirstTrue(DU(), changes));
    alignas(64) uint32_t prims[hn::MaxLanes(DU())];
    hn::Store(prim, DU(), prims);
    const U32 instance = scene.instance_count == 0 ? none : Gather(args.hits.instance, row);
    const Vec3 dir = Gather(args.dir, row);
    const Vec3 leaving = args.leaving.x == nullptr ? dir : Load(args.leaving, i);
    const Surface surface = HitSurface(scene, Gather(args.org, row), dir, Gather(args.hits.t, row),
                                       hn::IfThenElse(changes, instance, none),
                                       hn::IfThenElse(changes, prim, SetU(prims[leader])),
                                       Gather(args.hits.u, row), Gather(args.hits.v, row));
    const Mask out = hn::Gt(Dot(surface.n, leaving), hn::Zero(D()));
    const U32 entered = hn::IfThenElse(ToUintMask(out), outside, inside);
    Store(hn::IfThenElse(changes, entered, kept), args.after, i);
  }
}

}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::SWELL_WIDTH {
HWY_EXPORT(EnterMedia);
void EnterMedia(const EnterMediaArgs& args) { HWY_DYNAMIC_DISPATCH(EnterMedia)(args); }
}  // namespace swell::SWELL_WIDTH
#endif
