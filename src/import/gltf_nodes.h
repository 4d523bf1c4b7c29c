// The node hierarchy of a glTF file -> what it places in the world.
#ifndef SWELL_IMPORT_GLTF_NODES_H_
#define SWELL_IMPORT_GLTF_NODES_H_

#include <vector>

#include "src/import/gltf_file.h"
#include "src/import/transform.h"

namespace swell {

// A node of the scene that is shown.
struct GltfPlacedNode {
  int node = 0;
  Transform to_world;
};

// All nodes of the file's scene (the default one, else the first; all roots if there is none), each
// parent before its children. An error if the hierarchy is no forest.
Result<std::vector<GltfPlacedNode>> PlaceNodes(const GltfFile& file);

// The map of a translation, a rotation (quaternion x y z w, of any length) and a scale.
Transform FromParts(const Point& translation, const std::array<double, 4>& rotation,
                    const Point& scale);

}  // namespace swell

#endif  // SWELL_IMPORT_GLTF_NODES_H_
