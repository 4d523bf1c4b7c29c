// Materials of a glTF file -> what swell's shapes need: a material, opacity, emission, a medium.
#include "src/import/gltf_materials.h"

#include <algorithm>
#include <cmath>

#include "src/import/gltf_surface.h"
#include "src/import/gltf_values.h"

namespace swell {
namespace {

// All textures that a material names, those first whose coordinates cannot be mapped later.
std::vector<GltfTextureUse> TextureUses(const tinygltf::Material& material) {
  const auto& base = material.pbrMetallicRoughness;
  std::vector<GltfTextureUse> uses = {
      ReadTextureUse(material.normalTexture.index, material.normalTexture.texCoord,
                     material.normalTexture.extensions),
      ReadTextureUse(material.emissiveTexture.index, material.emissiveTexture.texCoord,
                     material.emissiveTexture.extensions),
      ReadTextureUse(base.baseColorTexture.index, base.baseColorTexture.texCoord,
                     base.baseColorTexture.extensions),
      ReadTextureUse(base.metallicRoughnessTexture.index, base.metallicRoughnessTexture.texCoord,
                     base.metallicRoughnessTexture.extensions)};
  for (const auto& [name, extension] : material.extensions) {
    if (!extension.IsObject()) continue;
    for (const std::string& key : extension.Keys()) {
      const bool texture = key.size() > 7 && key.substr(key.size() - 7) == "Texture";
      if (texture) uses.push_back(ReadTextureUse(&extension, key.c_str()));
    }
  }
  return uses;
}

// Coordinates whose first axis lies `angle` counter-clockwise of u, where v points down.
UvMap Turned(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {{c, -s, s, s, c, 1.0 - c}};
}

}  // namespace

const tinygltf::Material& GltfMaterials::Source(int material) {
  if (material < 0) return plain_;
  if (static_cast<size_t>(material) < file_.model().materials.size()) {
    return file_.model().materials[static_cast<size_t>(material)];
  }
  diagnostics_.Fail(place_, "there is no material " + std::to_string(material));
  return plain_;
}

std::optional<GltfUvFrame> GltfMaterials::Frame(int material) {
  const tinygltf::Material& source = Source(material);
  std::optional<GltfUvFrame> frame;
  for (const GltfTextureUse& use : TextureUses(source)) {
    if (!use) continue;
    frame = GltfUvFrame{use.uv_set, Inverse(use.map) ? use.map : UvMap{}};
    break;
  }
  if (const auto* anisotropy = FindExtension(source.extensions, "KHR_materials_anisotropy")) {
    if (!frame) frame = GltfUvFrame{};
    const bool fixed = source.normalTexture.index >= 0 || source.emissiveTexture.index >= 0;
    const double angle = NumberOf(anisotropy, "anisotropyRotation", 0.0);
    if (!fixed) {
      frame->map = Turned(angle) * frame->map;
    } else if (angle != 0.0) {
      diagnostics_.Warn(place_,
                        "\"anisotropyRotation\" of materials with maps of normals or "
                        "emission is ignored");
    }
  }
  return frame;
}

// Several surfaces may be made of one material.
uint32_t GltfMaterials::MediumRow(const Medium& medium) {
  if (medium.absorption == scene_.media[kVacuum].absorption) return kVacuum;
  const auto same = std::find_if(scene_.media.begin(), scene_.media.end(), [&](const Medium& row) {
    return row.name == medium.name && row.absorption == medium.absorption;
  });
  const auto row = static_cast<uint32_t>(same - scene_.media.begin());
  if (same == scene_.media.end()) scene_.media.push_back(medium);
  return row;
}

const GltfSurface& GltfMaterials::Surface(int material, const GltfVertexData& data) {
  const auto [at, is_new] = surfaces_.try_emplace({material, data});
  if (!is_new) return at->second;
  const tinygltf::Material& source = Source(material);
  GltfSurfaceMaker maker(source, data, data.uvs ? Frame(material) : std::nullopt, &textures_,
                         &diagnostics_, place_);
  Material made;
  at->second = maker.Make(&made);
  at->second.inside = MediumRow({source.name, maker.Absorption()});
  made.name = source.name;
  at->second.material = static_cast<uint32_t>(scene_.materials.size());
  scene_.materials.push_back(std::move(made));
  return at->second;
}

}  // namespace swell
