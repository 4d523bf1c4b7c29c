// Rays and a tree in, the closest hit of every ray out.
#ifndef SWELL_KERNELS_INTERSECT_RAYS_H_
#define SWELL_KERNELS_INTERSECT_RAYS_H_

#include "kernels/bvh_node.h"
#include "kernels/kernel.h"
#include "kernels/records.h"

namespace swell {

// Finds the hit with the least (t, prim) and t > 0 of rays [0, count), row for row. A miss has prim
// == kNoPrim and t = infinity. A ray that is not finite misses. Rows up to a multiple of
// kRowPadding are scratch. `hits` aliases nothing.
SWELL_KERNEL(LaneUse, IntersectRays, const BvhView& bvh, Traversal traversal,
             const Vec3Fields<In>& org, const Vec3Fields<In>& dir, const HitsOut& hits,
             size_t count);

}  // namespace swell

#endif  // SWELL_KERNELS_INTERSECT_RAYS_H_
