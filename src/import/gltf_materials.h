// Materials of a glTF file -> what swell's shapes need: a material, opacity, emission, a medium.
#ifndef SWELL_IMPORT_GLTF_MATERIALS_H_
#define SWELL_IMPORT_GLTF_MATERIALS_H_

#include <map>
#include <set>
#include <tuple>

#include "src/import/gltf_textures.h"
#include "src/import/shapes.h"

namespace swell {

// What a primitive has for its material to use.
struct GltfVertexData {
  std::set<int> uv_sets;
  bool colors = false;

  bool operator<(const GltfVertexData& o) const {
    return std::tie(uv_sets, colors) < std::tie(o.uv_sets, o.colors);
  }
};

struct GltfSurface {
  uint32_t material = 0;
  uint32_t alpha = kNoTexture;  // node of the opacity
  Emission emission;
  uint32_t inside = kVacuum;  // row of media
  GltfUvFrames frames;        // that its primitives are to store
  bool tangents = false;      // whether they are to store tangents too, if they have some
};

class GltfMaterials {
 public:
  GltfMaterials(const GltfFile& file, Scene* scene, Diagnostics* diagnostics, Place place)
      : file_(file),
        scene_(*scene),
        diagnostics_(*diagnostics),
        place_(place),
        textures_(file, scene, diagnostics, place) {}

  // `material` may be -1, glTF's default.
  const GltfSurface& Surface(int material, const GltfVertexData& data);

  Status LoadImages() { return textures_.LoadImages(); }

 private:
  const tinygltf::Material& Source(int material);
  static GltfUvFrames Frames(const tinygltf::Material& source, const std::set<int>& uv_sets);
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
