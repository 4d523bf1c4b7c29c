// Materials of a glTF file -> what swell's shapes need: a material, opacity, emission, a medium.
#include "src/import/gltf_materials.h"

#include <algorithm>

#include "src/import/gltf_surface.h"
#include "src/import/gltf_values.h"

namespace swell {
namespace {

// Of extensions, beside those that TextureUses names: pairs of the extension's name and its own.
constexpr const char* kFurtherTextures[] = {
    "KHR_materials_transmission", "transmissionTexture",        //
    "KHR_materials_specular",     "specularTexture",            //
    "KHR_materials_specular",     "specularColorTexture",       //
    "KHR_materials_clearcoat",    "clearcoatTexture",           //
    "KHR_materials_clearcoat",    "clearcoatRoughnessTexture",  //
    "KHR_materials_sheen",        "sheenColorTexture",          //
    "KHR_materials_sheen",        "sheenRoughnessTexture"};

GltfTextureUse EmissionUse(const tinygltf::Material& material) {
  const auto& base = material.pbrMetallicRoughness.baseColorTexture;
  const bool unlit = FindExtension(material.extensions, "KHR_materials_unlit") != nullptr;
  const tinygltf::TextureInfo& info = unlit ? base : material.emissiveTexture;
  return ReadTextureUse(info.index, info.texCoord, info.extensions);
}

// All textures that a material names, those first along whose coordinates tangents run.
std::vector<GltfTextureUse> TextureUses(const tinygltf::Material& material) {
  const auto& base = material.pbrMetallicRoughness;
  const auto of_extension = [&](const char* extension, const char* name) {
    return ReadTextureUse(FindExtension(material.extensions, extension), name);
  };
  std::vector<GltfTextureUse> uses = {
      ReadTextureUse(material.normalTexture.index, material.normalTexture.texCoord,
                     material.normalTexture.extensions),
      of_extension("KHR_materials_clearcoat", "clearcoatNormalTexture"),
      of_extension("KHR_materials_anisotropy", "anisotropyTexture"),
      EmissionUse(material),
      ReadTextureUse(base.baseColorTexture.index, base.baseColorTexture.texCoord,
                     base.baseColorTexture.extensions),
      ReadTextureUse(base.metallicRoughnessTexture.index, base.metallicRoughnessTexture.texCoord,
                     base.metallicRoughnessTexture.extensions)};
  for (const char* const* used = std::begin(kFurtherTextures); used != std::end(kFurtherTextures);
       used += 2) {
    uses.push_back(of_extension(used[0], used[1]));
  }
  return uses;
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

// Emission is looked up by stored coordinates as they are, so it must have a frame of its own if it
// is mapped unlike the first texture. Others of the same set are mapped from there.
GltfUvFrames GltfMaterials::Frames(const tinygltf::Material& source, const std::set<int>& uv_sets) {
  GltfUvFrames frames;
  const auto frame_of = [](const GltfTextureUse& use) {
    return GltfUvFrame{use.uv_set, Inverse(use.map) ? use.map : UvMap{}};
  };
  const auto usable = [&](const GltfTextureUse& use) {
    return use && uv_sets.count(use.uv_set) != 0;
  };
  const std::vector<GltfTextureUse> uses = TextureUses(source);
  const auto first = std::find_if(uses.begin(), uses.end(), usable);
  if (first != uses.end()) {
    frames.first = frame_of(*first);
    const GltfTextureUse emission = EmissionUse(source);
    const auto of_other_set = [&](const GltfTextureUse& use) {
      return usable(use) && use.uv_set != first->uv_set;
    };
    const auto other = std::find_if(uses.begin(), uses.end(), of_other_set);
    if (usable(emission) && !(frame_of(emission) == *frames.first)) {
      frames.second = frame_of(emission);
    } else if (other != uses.end()) {
      frames.second = frame_of(*other);
    }
  } else if (uv_sets.count(0) != 0 &&
             FindExtension(source.extensions, "KHR_materials_anisotropy") != nullptr) {
    frames.first = GltfUvFrame{};
  }
  return frames;
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
  const GltfUvFrames frames = Frames(source, data.uv_sets);
  GltfSurfaceMaker maker(source, data, frames, &textures_, &diagnostics_, place_);
  Material made;
  at->second = maker.Make(&made);
  at->second.inside = MediumRow({source.name, maker.Absorption()});
  made.name = source.name;
  at->second.material = static_cast<uint32_t>(scene_.materials.size());
  scene_.materials.push_back(std::move(made));
  return at->second;
}

}  // namespace swell
