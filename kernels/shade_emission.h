// Light that a path meets by scattering: surfaces that emit, and the background.
#ifndef SWELL_KERNELS_SHADE_EMISSION_H_
#define SWELL_KERNELS_SHADE_EMISSION_H_

#include "kernels/kernel.h"
#include "kernels/records.h"
#include "kernels/scene_view.h"

namespace swell {

// Adds to radiance[path] what the hit surfaces of rows [0, count) emit towards the ray, weighed
// against light sampling where that could have found it.
SWELL_KERNEL(void, ShadeEmission, const SceneView& scene, const RaysIn& rays, const HitsIn& hits,
             size_t count, const RgbFields<Out>& radiance);

}  // namespace swell

#endif  // SWELL_KERNELS_SHADE_EMISSION_H_
