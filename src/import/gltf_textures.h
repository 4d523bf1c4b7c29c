// References of glTF materials to textures -> texture nodes of the scene.
#ifndef SWELL_IMPORT_GLTF_TEXTURES_H_
#define SWELL_IMPORT_GLTF_TEXTURES_H_

#include <map>
#include <optional>
#include <string>

#include "src/import/diagnostics.h"
#include "src/import/gltf_images.h"
#include "src/import/uv_map.h"

namespace swell {

// A "textureInfo" of the file.
struct GltfTextureUse {
  int texture = -1;  // -1: none
  int uv_set = 0;
  UvMap map;           // KHR_texture_transform
  double scale = 1.0;  // of a normal map

  explicit operator bool() const { return texture >= 0; }
};

GltfTextureUse ReadTextureUse(int index, int uv_set, const tinygltf::ExtensionMap& extensions);
// The member `name` of an extension.
GltfTextureUse ReadTextureUse(const tinygltf::Value* extension, const char* name);

// The attribute that holds a set of texture coordinates.
inline std::string UvName(int uv_set) { return "TEXCOORD_" + std::to_string(uv_set); }

// Coordinates that a mesh stores for its material's textures: a set of the file's, mapped.
struct GltfUvFrame {
  int uv_set = 0;
  UvMap map;

  bool operator==(const GltfUvFrame& o) const { return uv_set == o.uv_set && map == o.map; }
};
// Its first coordinates, along which tangents run, and its second.
struct GltfUvFrames {
  std::optional<GltfUvFrame> first, second;
};

class GltfTextures {
 public:
  GltfTextures(const GltfFile& file, Scene* scene, Diagnostics* diagnostics, Place place)
      : file_(file),
        scene_(*scene),
        diagnostics_(*diagnostics),
        place_(place),
        images_(file, scene) {}

  // The node of a texture as seen by a mesh of these coordinates; kNoTexture if there is none, or
  // if it needs another set.
  uint32_t Node(const GltfTextureUse& use, const GltfImageUse& image, const GltfUvFrames& frames);
  uint32_t Constant(const std::array<double, 3>& value);
  uint32_t Product(uint32_t a, uint32_t b);
  // `node` times a colour.
  uint32_t Scaled(uint32_t node, const std::array<double, 3>& factor);
  // 1 where `node` is `edge` or more, else 0.
  uint32_t Step(uint32_t node, double edge);
  // Alpha or colour of the vertices.
  uint32_t VertexColor(bool alpha);

  // A row of the scene's image_lights; kNoTexture if there is none.
  uint32_t Emission(const GltfTextureUse& use, const GltfUvFrames& frames);

  Status LoadImages() { return images_.Load(); }

 private:
  int ImageOf(int texture);
  const GltfUvFrame* FrameOf(const GltfTextureUse& use, const GltfUvFrames& frames);
  SurfaceLookup SamplerOf(int texture) const;
  uint32_t Add(const TextureStep& step);

  const GltfFile& file_;
  Scene& scene_;
  Diagnostics& diagnostics_;
  Place place_;
  GltfImages images_;
  std::map<std::string, uint32_t> nodes_;  // by their bytes
};

}  // namespace swell

#endif  // SWELL_IMPORT_GLTF_TEXTURES_H_
