// A scene and what was made of it -> the counts, sizes and names that `swell info` tells.
#ifndef SWELL_CLI_SCENE_FACTS_H_
#define SWELL_CLI_SCENE_FACTS_H_

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "kernels/material.h"
#include "src/scene/objects.h"
#include "src/scene/scene.h"

namespace swell {

// What `swell info` says of the tree.
struct TreeSummary {
  uint64_t nodes = 0, blocks = 0, depth = 0, bytes = 0;
};

struct TextureFacts {
  std::string name;  // of its file, or ""
  std::string use;   // "texture", "light"
  std::string format;
  uint32_t width = 0, height = 0, channels = 0;
  uint64_t bytes = 0;
};

struct WarningFacts {
  std::string text;    // the first of its kind, with its place
  uint64_t count = 1;  // of all that differ in place, names and numbers only
};

struct SceneFacts {
  uint64_t meshes = 0, objects = 0, instances = 0;
  PrimCounts unique, drawn;
  uint64_t left_out = 0;  // triangles without area
  uint64_t vertices = 0, normals = 0, uvs = 0;
  Bounds bounds;
  std::map<std::string, uint64_t> materials, lights;                 // by kind and type
  std::vector<std::pair<std::string, std::string>> material_labels;  // and their kinds
  std::vector<TextureFacts> textures;
  Camera camera;
  RenderRequest request;
  TreeSummary tree;
  std::vector<std::pair<std::string, uint64_t>> memory;  // bytes by part
  uint64_t memory_bytes = 0;
  std::vector<std::pair<std::string, double>> seconds;  // by phase
  // Of the process, at the end of each phase; pages of mapped files count.
  std::vector<std::pair<std::string, std::optional<uint64_t>>> peak_rss_bytes;
  std::vector<WarningFacts> warnings;
};

// All but `seconds` and `peak_rss_bytes`.
SceneFacts CollectFacts(const Scene& scene, const SceneTables& tables,
                        std::span<const MaterialInfo* const> kinds, const TreeSummary& tree);

// "file:3: texture 'a.png' is odd" and "file:9: texture 'b.png' is odd" are one group of two.
std::vector<WarningFacts> GroupWarnings(const std::vector<std::string>& warnings);

}  // namespace swell

#endif  // SWELL_CLI_SCENE_FACTS_H_
