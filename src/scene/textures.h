// Textures of a scene -> programs for kernels: only the steps that a material or a shape needs.
#ifndef SWELL_SCENE_TEXTURES_H_
#define SWELL_SCENE_TEXTURES_H_

#include <cstdint>
#include <functional>
#include <vector>

#include "kernels/texture_view.h"

namespace swell {

struct Scene;

// A parameter of a material that a texture varies: words [word, word + count).
struct MaterialTexture {
  uint32_t node;  // row of Scene::texture_nodes
  uint32_t word;
  uint32_t count;
  float min, max;
};

struct TextureTables {
  std::vector<TextureStep> steps;
  std::vector<TextureOutput> outputs;
  std::vector<TextureProgram> programs;
  std::vector<ImageView> images;
  std::vector<uint32_t> material_program;  // in the order of the kernels' materials
  std::vector<uint32_t> shape_alpha;       // program of each shape's opacity, or kNoTexture
  std::vector<uint32_t> mix_program;       // likewise of each mix's amount
  uint32_t column_count = 0;               // most columns that a material's program writes
  TexturesView view{};
};

// The step of a row of images as a normal map: repeated, by the mesh's coordinates.
TextureStep NormalMapStep(uint32_t image);

// Nodes that `node` is made of, itself last; each only once and after those it needs.
std::vector<uint32_t> NodesBelow(const std::vector<TextureStep>& nodes, uint32_t node);
// The same where nodes are not in one array.
using TextureNodeOf = std::function<const TextureStep&(uint32_t node)>;
std::vector<uint32_t> NodesBelow(const TextureNodeOf& node_of, uint32_t node);

// `material_order` is the scene's material of each of the kernels' materials.
TextureTables MakeTextureTables(const Scene& scene, const std::vector<uint32_t>& material_order);

}  // namespace swell

#endif  // SWELL_SCENE_TEXTURES_H_
