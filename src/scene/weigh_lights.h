// The lights of unfinished tables in; how they are drawn out.
#ifndef SWELL_SCENE_WEIGH_LIGHTS_H_
#define SWELL_SCENE_WEIGH_LIGHTS_H_

#include "src/scene/scene.h"

namespace swell {

// Completes tables.lights and fills what view.lights says of drawing them. There must be some.
void WeighLights(const Scene& scene, LightSampler sampler, SceneTables& tables);

}  // namespace swell

#endif  // SWELL_SCENE_WEIGH_LIGHTS_H_
