// Lights of shapes with holes: light sampling asks for the opacity where it asks for images, and is
// all there is where the opacity is 0.
#ifndef SWELL_SCENE_HOLED_LIGHTS_H_
#define SWELL_SCENE_HOLED_LIGHTS_H_

#include "src/scene/scene.h"

namespace swell {

// Emitters with holes that have no image get a white one, appended to tables.image_lights; those
// of opacity 0 become kLightUnseen.
void MarkHoles(const Scene& scene, SceneTables& tables);

}  // namespace swell

#endif  // SWELL_SCENE_HOLED_LIGHTS_H_
