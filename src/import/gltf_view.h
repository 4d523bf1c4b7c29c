// Lights and cameras of a glTF file -> those of the scene.
#ifndef SWELL_IMPORT_GLTF_VIEW_H_
#define SWELL_IMPORT_GLTF_VIEW_H_

#include <string>
#include <vector>

#include "src/import/diagnostics.h"
#include "src/import/gltf_nodes.h"

namespace swell {

// KHR_lights_punctual. Candela, lux and nits become swell's units one to one, so that all of the
// file's lights and emission stay in proportion.
void AddGltfLights(const GltfFile& file, const std::vector<GltfPlacedNode>& nodes,
                   Diagnostics* diagnostics, Place place, Scene* scene);

// The camera of that name (its own or its node's) or index; the first that is placed for "". False
// if there is none to be used.
bool SetGltfCamera(const GltfFile& file, const std::vector<GltfPlacedNode>& nodes,
                   const std::string& wanted, Diagnostics* diagnostics, Place place, Scene* scene);

}  // namespace swell

#endif  // SWELL_IMPORT_GLTF_VIEW_H_
