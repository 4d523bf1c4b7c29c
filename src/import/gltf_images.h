// Images that a glTF file's textures use -> rows of the scene's images, each decoded once.
#ifndef SWELL_IMPORT_GLTF_IMAGES_H_
#define SWELL_IMPORT_GLTF_IMAGES_H_

#include <map>
#include <tuple>
#include <vector>

#include "src/import/gltf_file.h"
#include "src/import/read_image.h"
#include "src/scene/scene.h"

namespace swell {

// How a texture looks at its image.
struct GltfImageUse {
  ImageUse use = ImageUse::kColor;
  bool srgb = false;
  bool normals = false;       // of a normal map, which is not filtered
  double normal_scale = 1.0;  // of its slopes
};

class GltfImages {
 public:
  GltfImages(const GltfFile& file, Scene* scene) : file_(file), scene_(*scene) {}

  // A row of the scene's images, empty until Load.
  uint32_t Row(int image, const GltfImageUse& use);
  // A row of the scene's image_lights, loaded at once: what surfaces emit.
  Result<uint32_t> EmissionRow(int image, const SurfaceLookup& lookup);

  // Decodes the images of all rows, in parallel. An error names the image.
  Status Load();

 private:
  struct Wanted {
    uint32_t row;
    GltfImageUse use;
  };
  Status LoadImage(int image, const std::vector<Wanted>& wanted);

  const GltfFile& file_;
  Scene& scene_;
  std::map<std::tuple<int, ImageUse, bool, bool, double>, uint32_t> rows_;
  std::map<int, std::vector<Wanted>> wanted_;  // by image
  std::map<std::tuple<int, TextureWrap, TextureWrap, TextureFilter, uint32_t>, uint32_t>
      emission_rows_;
};

}  // namespace swell

#endif  // SWELL_IMPORT_GLTF_IMAGES_H_
