// Parameters of lights that are images -> lights of the scene with their pixels.
#ifndef SWELL_IMPORT_IMAGE_LIGHTS_H_
#define SWELL_IMPORT_IMAGE_LIGHTS_H_

#include <string>

#include "src/import/parameters.h"
#include "src/import/transform.h"
#include "src/scene/scene.h"

namespace swell {

// Each fills `light` but for its type's common fields, and appends to scene->image_lights. A
// failure is the parameters'.
void ReadSkyImage(Parameters& parameters, const Parameter& file, const Transform& to_world,
                  LightRecord* light, Scene* scene);
void ReadGoniometric(Parameters& parameters, const Transform& to_world, LightRecord* light,
                     Scene* scene);
void ReadProjection(Parameters& parameters, const Transform& to_world, LightRecord* light,
                    Scene* scene);

// The image that a parameter names, for a light: all its values must be finite.
bool ReadLightImage(Parameters& parameters, const Parameter& file, TexelImage* image);

// Luminance of linear sRGB.
double Luminance(const std::array<float, 3>& rgb);

}  // namespace swell

#endif  // SWELL_IMPORT_IMAGE_LIGHTS_H_
