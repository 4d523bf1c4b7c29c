// A scene in, the expected cost of the tree that Embree's general builder makes of it out.
#ifndef SWELL_BENCH_BUILD_EMBREE_COST_H_
#define SWELL_BENCH_BUILD_EMBREE_COST_H_

#include <embree3/rtcore.h>

#include "src/bvh/expected_cost.h"
#include "src/scene/scene.h"

namespace swell::bench {

// rtcBuildBVH with eight children a node and leaves of four, as its own triangle scenes have, or of
// eight, as swell has: the lower cost of the two. A block of up to eight triangles is one test in
// both trees. The trees of Embree's scenes cannot be walked from outside; their builder is the
// same.
ExpectedCost FindEmbreeCost(RTCDevice device, const Scene& scene, RTCBuildQuality quality);

}  // namespace swell::bench

#endif  // SWELL_BENCH_BUILD_EMBREE_COST_H_
