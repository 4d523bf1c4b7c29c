// Materials of a glTF file -> what swell's shapes need: a material, opacity, emission, a medium.
#ifndef SWELL_IMPORT_GLTF_MATERIALS_H_
#define SWELL_IMPORT_GLTF_MATERIALS_H_

#include <map>
#include <tuple>

#include "src/import/gltf_textures.h"
#include "src/import/shapes.h"

namespace swell {

// What a primitive has for its material to use.
struct GltfVertexData {
  bool uvs = false;  // of the set that GltfMaterials::Frame tells
  bool colors = false;

  bool operator<(const GltfVertexData& o) const {
    return std::tuple(uvs, colors) < std::tuple(o.uvs, o.colors);
  }
};

struct GltfSurface {
  uint32_t material = 0;
  uint32_t alpha = kNoTexture;  // node of the opacity
  Emission emission;
  uint32_t inside = kVacuum;  // row of media
};

class GltfMaterials {
 public:
  GltfMaterials(const GltfFile& file, Scene* scene, Diagnostics* diagnostics, Place place)
      : file_(file),
        scene_(*scene),
        diagnostics_(*diagnostics),
        place_(place),
        textures_(file, scene, diagnostics, place) {}

  // The texture coordinates that a material's primitives are to store; nothing without textures.
  // `material` may be -1, glTF's default.
  std::optional<GltfUvFrame> Frame(int material);
  const GltfSurface& Surface(int material, const GltfVertexData& data);

  Status LoadImages() { return textures_.LoadImages(); }

 private:
  const tinygltf::Material& Source(int material);
  uint32_t MediumRow(const Medium& medium);

  const GltfFile& file_;
  Scene& scene_;
  Diagnostics& diagnostics_;
  Place place_;
  GltfTextures textures_;
  tinygltf::Material plain_;
  std::map<std::pair<int, GltfVertexData>, GltfSurface> surfaces_;
};

}  // namespace swell

#endif  // SWELL_IMPORT_GLTF_MATERIALS_H_
