// Lane maths as kernels over columns, so that tests can call it on every target and width.
#ifndef SWELL_TESTS_KERNELS_LANE_PROBE_H_
#define SWELL_TESTS_KERNELS_LANE_PROBE_H_

#include "kernels/kernel.h"
#include "kernels/scene_view.h"

namespace swell {

// Columns are words; those of floats hold their bits. All are readable and writable up to the
// padding.
struct ProbeArgs {
  const uint32_t* const* in;
  uint32_t* const* out;
  size_t count;
  const SceneView* scene = nullptr;
  uint32_t seed = 0;
  SamplerView sampler = {};
};

// pixel, sample, pair -> x, y of the path's sampler.
SWELL_KERNEL(void, ProbeSamplerPair, const ProbeArgs& args);
// word, seed -> ReverseBits(word), ScrambleReversed(word, seed), SobolSecondReversed(word).
SWELL_KERNEL(void, ProbeSobol, const ProbeArgs& args);
// value, up (0 or 1) -> the next float that way.
SWELL_KERNEL(void, ProbeNextFloat, const ProbeArgs& args);
// z of a frame (3), a vector (3) -> x, y of the frame (6), the vector in local space and back (6).
SWELL_KERNEL(void, ProbeFrame, const ProbeArgs& args);
// a point of the surface (3), prim, shading normal (3) -> x, y, z of the frame along u (9).
SWELL_KERNEL(void, ProbeTangent, const ProbeArgs& args);
// org (3), dir (3), t, prim, u, v -> p, error, n, ns (12), area_scale.
SWELL_KERNEL(void, ProbeSurface, const ProbeArgs& args);
// The same with the instance as eleventh column.
SWELL_KERNEL(void, ProbeHitSurface, const ProbeArgs& args);
// p, error, n, w (12) -> the moved origin (3).
SWELL_KERNEL(void, ProbeOffsetOrigin, const ProbeArgs& args);
// p (3), u_select, u0, u1 -> wi, end (6), radiance (3), pdf, at_infinity | is_delta << 1, light.
SWELL_KERNEL(void, ProbeSampleLight, const ProbeArgs& args);
// light, org (3), t, cos, area_scale -> pdf.
SWELL_KERNEL(void, ProbeLightPdf, const ProbeArgs& args);
// n (3) -> its code, and the normal that the code stands for (3).
SWELL_KERNEL(void, ProbeNormalCode, const ProbeArgs& args);
// pdf, other -> weight of the power heuristic.
SWELL_KERNEL(void, ProbePowerHeuristic, const ProbeArgs& args);

}  // namespace swell

#endif  // SWELL_TESTS_KERNELS_LANE_PROBE_H_
