// MTL materials -> materials of the scene, and what they ask of the shapes that have them.
#ifndef SWELL_IMPORT_MTL_SURFACES_H_
#define SWELL_IMPORT_MTL_SURFACES_H_

#include "src/import/mtl_file.h"
#include "src/import/mtl_textures.h"
#include "src/import/shapes.h"
#include "src/scene/scene.h"

namespace swell {

struct MtlSurface {
  uint32_t material = 0;        // row of the scene's materials
  uint32_t alpha = kNoTexture;  // row of its texture_nodes
  Emission emission;
};

class MtlSurfaces {
 public:
  // `size` is the model's, by which bump maps are scaled.
  MtlSurfaces(Scene* scene, Diagnostics* diagnostics, double size)
      : scene_(*scene), diagnostics_(*diagnostics), textures_(scene, diagnostics), size_(size) {}

  // What docs/models.md tells of each statement.
  MtlSurface Make(const MtlMaterial& mtl);

 private:
  Material MakePbr(const MtlMaterial& mtl);
  Material MakeGlass(const MtlMaterial& mtl);
  Material MakePhong(const MtlMaterial& mtl);
  void SetBaseColor(std::string_view parameter, const MtlMaterial& mtl, Material* material);
  void AddRelief(const MtlMaterial& mtl, Material* material);
  void VaryBy(const std::string& name, const tinyobj::texture_option_t& options,
              const MtlMaterial& mtl, std::string_view parameter, double factor,
              Material* material);
  uint32_t Opacity(const MtlMaterial& mtl);
  Emission MakeEmission(const MtlMaterial& mtl);

  Scene& scene_;
  Diagnostics& diagnostics_;
  MtlTextures textures_;
  double size_;
};

// Of surfaces whose file says nothing of them.
Material ClayMaterial();

}  // namespace swell

#endif  // SWELL_IMPORT_MTL_SURFACES_H_
