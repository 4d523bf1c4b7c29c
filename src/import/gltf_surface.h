// One material of a glTF file and what its primitives have -> a surface of the scene.
#ifndef SWELL_IMPORT_GLTF_SURFACE_H_
#define SWELL_IMPORT_GLTF_SURFACE_H_

#include "src/import/gltf_materials.h"

namespace swell {

// Factor times texture, as a parameter of a material may be.
struct GltfInput {
  std::array<double, 3> factor{1, 1, 1};  // of a number, in all three
  uint32_t texture = kNoTexture;
};

class GltfSurfaceMaker {
 public:
  GltfSurfaceMaker(const tinygltf::Material& source, const GltfVertexData& data,
                   const GltfUvFrames& frames, GltfTextures* textures, Diagnostics* diagnostics,
                   Place place);

  // The surface, with `material` and what it absorbs yet to be put into the scene.
  GltfSurface Make(Material* material);
  // What the volume that the surface closes takes from light, per unit of the world's length.
  std::array<float, 3> Absorption() const;

 private:
  void MakePrincipled(Material* material);
  void MakeGlass(Material* material);
  void MakeUnlit(GltfSurface* surface, Material* material);
  void ReadTransmission(Material* material);
  void ReadSpecular(Material* material);
  void ReadClearcoat(Material* material);
  void ReadSheen(Material* material);
  void ReadAnisotropy(Material* material);
  void ReadNormals(Material* material);
  void ReadEmission(GltfSurface* surface);
  uint32_t ReadAlpha();
  void WarnOfMissing();

  bool Closes() const;
  bool NeedsTangents() const;  // of principled

  const tinygltf::Value* Extension(const char* name) const;
  uint32_t Texture(const GltfTextureUse& use, ImageUse channel, bool srgb);
  // Member `name` of an extension, times a texture of it.
  GltfInput Number(const tinygltf::Value* extension, const char* name, double fallback,
                   const char* texture, ImageUse channel);
  GltfInput Color(const tinygltf::Value* extension, const char* name, double fallback,
                  const char* texture);
  GltfInput BaseColor();
  GltfInput Squared(const GltfInput& input);
  void Set(Material* material, const char* parameter, const GltfInput& input);

  const tinygltf::Material& source_;
  GltfVertexData data_;
  GltfUvFrames frames_;
  GltfTextures& textures_;
  Diagnostics& diagnostics_;
  Place place_;
};

}  // namespace swell

#endif  // SWELL_IMPORT_GLTF_SURFACE_H_
