// Parts of glTF materials as text, and what became of them in a scene.
#ifndef SWELL_TESTS_IMPORT_GLTF_MATERIAL_TEXTS_H_
#define SWELL_TESTS_IMPORT_GLTF_MATERIAL_TEXTS_H_

#include <optional>
#include <string>

#include "kernels/material.h"
#include "tests/import/gltf_texts.h"

namespace swell::test {

inline const std::string kPbr = "\"pbrMetallicRoughness\":";
inline const std::string kTexture0 = "{\"index\":0}";

inline std::string Extension(const std::string& name, const std::string& members) {
  return "\"extensions\":{\"" + name + "\":{" + members + "}}";
}

inline uint32_t WordOf(const Material& material, std::string_view name) {
  const MaterialInfo& info = *kMaterialKinds[material.kind];
  for (uint32_t i = 0; i < info.param_count; ++i) {
    if (name == info.params[i].name) return ParamOffset(info, i);
  }
  FAIL("no parameter " << std::string(name));
  return 0;
}
inline float Value(const Material& material, std::string_view name, uint32_t channel = 0) {
  return material.params[WordOf(material, name) + channel];
}
inline std::string KindOf(const Material& material) { return kMaterialKinds[material.kind]->name; }

// The node that gives a parameter, if a texture does.
inline std::optional<TextureStep> NodeOf(const Scene& scene, std::string_view name) {
  const Material& material = scene.materials[0];
  for (const MaterialTexture& texture : material.textures) {
    if (texture.word == WordOf(material, name)) return scene.texture_nodes[texture.node];
  }
  return std::nullopt;
}

}  // namespace swell::test

#endif  // SWELL_TESTS_IMPORT_GLTF_MATERIAL_TEXTS_H_
