// Collects the nodes of each material's textures into one program.
#include "src/scene/textures.h"

#include <algorithm>

#include "src/base/check.h"
#include "src/scene/scene.h"

namespace swell {
namespace {

// How many inputs a step reads.
uint32_t InputCount(TextureOp op) {
  switch (op) {
    case TextureOp::kScale:
    case TextureOp::kDirectionMix:
    case TextureOp::kCheckerboard2:
    case TextureOp::kCheckerboard3:
    case TextureOp::kDots:
      return 2;
    case TextureOp::kMix:
      return 3;
    case TextureOp::kStep:
      return 1;
    default:
      return 0;
  }
}

class ProgramMaker {
 public:
  ProgramMaker(const Scene& scene, TextureTables& tables) : scene_(scene), tables_(tables) {}

  // A program whose steps are the sorted `nodes`.
  uint32_t Make(const std::vector<uint32_t>& nodes) {
    SWELL_CHECK(nodes.size() <= kMaxTextureSteps);
    TextureProgram program{static_cast<uint32_t>(tables_.steps.size()),
                           static_cast<uint32_t>(nodes.size()),
                           static_cast<uint32_t>(tables_.outputs.size()),
                           0,
                           kNoTexture,
                           kNoTexture,
                           false};
    for (uint32_t node : nodes) {
      TextureStep step = scene_.texture_nodes[node];
      for (uint32_t i = 0; i < InputCount(step.op); ++i)
        step.input[i] = Place(nodes, step.input[i]);
      tables_.steps.push_back(step);
    }
    tables_.programs.push_back(program);
    return static_cast<uint32_t>(tables_.programs.size() - 1);
  }

  uint32_t MakeMaterial(const Material& material) {
    if (material.textures.empty() && material.displacement == kNoTexture &&
        material.normal_map == kNoTexture) {
      return kNoTexture;
    }
    std::vector<uint32_t> nodes;
    for (const MaterialTexture& texture : material.textures) {
      const std::vector<uint32_t> below = NodesBelow(scene_.texture_nodes, texture.node);
      nodes.insert(nodes.end(), below.begin(), below.end());
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    uint32_t bump = kNoTexture;
    if (material.displacement != kNoTexture) {
      bump = Make(NodesBelow(scene_.texture_nodes, material.displacement));
    }
    const uint32_t index = Make(nodes);
    TextureProgram& program = tables_.programs[index];
    program.bump = bump;
    if (material.normal_map != kNoTexture) {
      program.normal_map = static_cast<uint32_t>(tables_.steps.size());
      tables_.steps.push_back(scene_.texture_nodes[material.normal_map]);
    }
    program.normal_map_follows_v = material.normal_map_follows_v;
    uint32_t columns = bump != kNoTexture || program.normal_map != kNoTexture ? 3 : 0;
    for (const MaterialTexture& texture : material.textures) {
      tables_.outputs.push_back(
          {Place(nodes, texture.node), texture.word, texture.count, texture.min, texture.max});
      columns += texture.count;
    }
    program.output_count = static_cast<uint32_t>(material.textures.size());
    tables_.column_count = std::max(tables_.column_count, columns);
    return index;
  }

 private:
  static uint32_t Place(const std::vector<uint32_t>& nodes, uint32_t node) {
    return static_cast<uint32_t>(std::lower_bound(nodes.begin(), nodes.end(), node) -
                                 nodes.begin());
  }

  const Scene& scene_;
  TextureTables& tables_;
};

}  // namespace

TextureStep NormalMapStep(uint32_t image) {
  TextureStep step;
  step.op = TextureOp::kImage;
  step.image = image;
  step.value[0] = 1.0f;
  return step;
}

std::vector<uint32_t> NodesBelow(const std::vector<TextureStep>& nodes, uint32_t node) {
  return NodesBelow([&](uint32_t row) -> const TextureStep& { return nodes[row]; }, node);
}

std::vector<uint32_t> NodesBelow(const TextureNodeOf& node_of, uint32_t node) {
  std::vector<uint32_t> found, open{node};
  while (!open.empty()) {
    const uint32_t next = open.back();
    open.pop_back();
    if (std::find(found.begin(), found.end(), next) != found.end()) continue;
    found.push_back(next);
    const TextureStep& step = node_of(next);
    open.insert(open.end(), step.input, step.input + InputCount(step.op));
  }
  std::sort(found.begin(), found.end());  // inputs come before what reads them
  return found;
}

TextureTables MakeTextureTables(const Scene& scene, const std::vector<uint32_t>& material_order) {
  TextureTables tables;
  ProgramMaker maker(scene, tables);
  for (const TexelImage& image : scene.images) tables.images.push_back(image.view());
  for (uint32_t material : material_order) {
    tables.material_program.push_back(maker.MakeMaterial(scene.materials[material]));
  }
  for (const Shape& shape : scene.shapes) {
    tables.shape_alpha.push_back(shape.alpha == kNoTexture
                                     ? kNoTexture
                                     : maker.Make(NodesBelow(scene.texture_nodes, shape.alpha)));
  }
  bool textured_mixes = false;
  for (const Mix& mix : scene.mixes) {
    const bool textured = mix.amount_texture != kNoTexture;
    tables.mix_program.push_back(
        textured ? maker.Make(NodesBelow(scene.texture_nodes, mix.amount_texture)) : kNoTexture);
    textured_mixes |= textured;
  }
  const bool any_alpha = std::any_of(tables.shape_alpha.begin(), tables.shape_alpha.end(),
                                     [](uint32_t program) { return program != kNoTexture; });
  tables.view = {tables.steps.data(),
                 tables.outputs.data(),
                 tables.programs.data(),
                 tables.images.data(),
                 tables.column_count != 0 ? tables.material_program.data() : nullptr,
                 any_alpha ? tables.shape_alpha.data() : nullptr,
                 textured_mixes};
  return tables;
}

}  // namespace swell
