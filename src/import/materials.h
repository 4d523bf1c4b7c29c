// Parameters of a Material or MakeNamedMaterial directive -> a material of the registry.
#ifndef SWELL_IMPORT_MATERIALS_H_
#define SWELL_IMPORT_MATERIALS_H_

#include <string>

#include "src/import/parameters.h"
#include "src/scene/scene.h"

namespace swell {

// Reads a material of the kind `type` with all its parameters. A kind of pbrt that swell lacks
// becomes diffuse, with a warning; an unknown one fails.
Material ReadMaterial(Parameters& parameters, const std::string& type);

// `kind` with its default parameters.
Material DefaultMaterial(const std::string& kind);

// What a surface of the material emits by itself: its "emissive" times "emissive_strength".
std::array<float, 3> EmittedRadiance(const Material& material);

// The surface that light passes unchanged, which has no row in the scene.
bool IsInterfaceMaterial(const std::string& type);

}  // namespace swell

#endif  // SWELL_IMPORT_MATERIALS_H_
