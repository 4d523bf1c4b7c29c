// LightSource and AreaLightSource directives -> lights of the scene, emission of shapes.
#ifndef SWELL_IMPORT_LIGHTS_H_
#define SWELL_IMPORT_LIGHTS_H_

#include <string>

#include "src/import/parameters.h"
#include "src/import/shapes.h"
#include "src/import/transform.h"
#include "src/scene/scene.h"

namespace swell {

void ReadLightSource(Parameters& parameters, const std::string& type, const Transform& to_world,
                     Scene* scene);
Emission ReadAreaLight(Parameters& parameters, const std::string& type, Scene* scene);

}  // namespace swell

#endif  // SWELL_IMPORT_LIGHTS_H_
