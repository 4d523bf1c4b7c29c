// Starts paths: one camera ray for each listed pixel.
#ifndef SWELL_KERNELS_GENERATE_RAYS_H_
#define SWELL_KERNELS_GENERATE_RAYS_H_

#include "kernels/kernel.h"
#include "kernels/records.h"
#include "kernels/scene_view.h"

namespace swell {

struct GenerateRaysArgs {
  CameraView camera;
  FilterView filter;
  uint32_t seed;
  uint32_t sample;         // index within each pixel
  const uint32_t* pixels;  // x | y << 16; `count` rows
  const uint32_t* slots;   // rows of `paths` to use, all different
  size_t count;
  SamplerView sampler = {};
};

// Writes rows [0, count) of `rays`, not their padding, and row slots[i] of `paths`. `rays` may
// start at any row: rows are added behind live ones, and the next window's may follow.
SWELL_KERNEL(void, GenerateRays, const GenerateRaysArgs& args, const RaysOut& rays,
             const PathsOut& paths);

}  // namespace swell

#endif  // SWELL_KERNELS_GENERATE_RAYS_H_
