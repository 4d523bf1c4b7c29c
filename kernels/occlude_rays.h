// Shadow rays and a tree in; the paths whose ray is free gain its radiance.
#ifndef SWELL_KERNELS_OCCLUDE_RAYS_H_
#define SWELL_KERNELS_OCCLUDE_RAYS_H_

#include "kernels/bvh_node.h"
#include "kernels/kernel.h"
#include "kernels/records.h"

namespace swell {

// Adds shadow.radiance to path_radiance[shadow.path] for the rays of [0, count) without a hit at 0
// < t < t_max. Every path occurs at most once in a call. A ray that is not finite hits nothing.
// Rows up to a multiple of kRowPadding are readable.
SWELL_KERNEL(LaneUse, OccludeRays, const BvhView& bvh, Traversal traversal,
             const ShadowRaysIn& shadow, const RgbFields<Out>& path_radiance, size_t count);

}  // namespace swell

#endif  // SWELL_KERNELS_OCCLUDE_RAYS_H_
