// What was read from a scene file, as text for a person.
#ifndef SWELL_CLI_SCENE_TEXT_H_
#define SWELL_CLI_SCENE_TEXT_H_

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "kernels/material.h"
#include "src/scene/scene.h"

namespace swell {

// What `swell info` says of the tree.
struct TreeSummary {
  uint64_t nodes = 0, blocks = 0, depth = 0, bytes = 0;
  double seconds = 0;  // to build
};

// Counts, bounds, materials by kind, lights by type, camera, film, memory by part, the tree.
std::string SceneText(const Scene& scene, const SceneTables& tables,
                      std::span<const MaterialInfo* const> kinds, const TreeSummary& tree,
                      double import_seconds);

}  // namespace swell

#endif  // SWELL_CLI_SCENE_TEXT_H_
