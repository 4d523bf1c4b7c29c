// Textures that MTL materials name -> images and texture nodes of the scene.
#ifndef SWELL_IMPORT_MTL_TEXTURES_H_
#define SWELL_IMPORT_MTL_TEXTURES_H_

#include <tiny_obj_loader.h>

#include <array>
#include <map>
#include <string>
#include <utility>

#include "src/import/diagnostics.h"
#include "src/import/read_image.h"
#include "src/scene/scene.h"

namespace swell {

// A texture as a statement names it: map_Kd -s 2 2 brick.png.
struct MtlTexture {
  const std::string& name;
  const tinyobj::texture_option_t& options;
  Place place;  // of the material; its file's folder is where names begin
};

enum class MtlImageUse { kColor, kNumber, kHeight, kNormal, kLight };

class MtlTextures {
 public:
  MtlTextures(Scene* scene, Diagnostics* diagnostics)
      : scene_(*scene), diagnostics_(*diagnostics) {}

  // The row of the scene's images (of its image_lights for kLight), each file only once for each
  // use; kNoTexture, and a warning, if it cannot be read.
  uint32_t Image(const MtlTexture& texture, MtlImageUse use);
  // A node of the scene: the image as the options place it, times `factor`; or kNoTexture.
  uint32_t Node(const MtlTexture& texture, MtlImageUse use, const std::array<double, 3>& factor);
  uint32_t Constant(const std::array<double, 3>& value);
  // The image as a normal map, wherever the options place it; or kNoTexture.
  uint32_t NormalMap(const MtlTexture& texture, MtlImageUse use);

  // Whether the image that is said to be heights holds normals: most exporters' bump maps do.
  bool HoldsNormals(uint32_t image) const { return looks_like_normals_.at(image); }

 private:
  uint32_t Read(const std::string& path, MtlImageUse use, Place place);
  uint32_t Add(const TextureStep& step);

  Scene& scene_;
  Diagnostics& diagnostics_;
  std::map<std::pair<std::string, MtlImageUse>, uint32_t> rows_;
  std::map<uint32_t, bool> looks_like_normals_;  // of images for kHeight
};

}  // namespace swell

#endif  // SWELL_IMPORT_MTL_TEXTURES_H_
