// Images and skies as kernels over columns, so that tests can call them on every target and width.
#ifndef SWELL_TESTS_KERNELS_IMAGE_PROBE_H_
#define SWELL_TESTS_KERNELS_IMAGE_PROBE_H_

#include "tests/kernels/lane_probe.h"

namespace swell {

// direction (3) -> its point in the equal-area square (2), the direction of that point (3), its
// point in the latitude-longitude map (2).
SWELL_KERNEL(void, ProbeSphereMaps, const ProbeArgs& args);
// x, y -> texel of level `seed` of the scene's image light 0 (3).
SWELL_KERNEL(void, ProbeTexel, const ProbeArgs& args);
// direction (3) -> radiance (3) and density of the scene's image light 0.
SWELL_KERNEL(void, ProbeSky, const ProbeArgs& args);

}  // namespace swell

#endif  // SWELL_TESTS_KERNELS_IMAGE_PROBE_H_
