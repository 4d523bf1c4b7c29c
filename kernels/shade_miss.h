// Rays that left the scene: the background shines on their paths.
#ifndef SWELL_KERNELS_SHADE_MISS_H_
#define SWELL_KERNELS_SHADE_MISS_H_

#include "kernels/kernel.h"
#include "kernels/records.h"
#include "kernels/scene_view.h"

namespace swell {

// Adds the infinite lights' radiance to radiance[path] of the listed rows, weighed against light
// sampling where that could have found it. `rows` is readable up to the padding.
SWELL_KERNEL(void, ShadeMiss, const SceneView& scene, const RaysIn& rays, const uint32_t* rows,
             size_t count, const RgbFields<Out>& radiance);

}  // namespace swell

#endif  // SWELL_KERNELS_SHADE_MISS_H_
