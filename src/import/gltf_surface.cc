// One material of a glTF file and what its primitives have -> a surface of the scene.
#include "src/import/gltf_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "kernels/material.h"
#include "src/import/gltf_values.h"
#include "src/import/material_words.h"
#include "src/import/materials.h"

namespace swell {
namespace {

constexpr double kMostRadiance = 1e30, kMostAbsorption = 1e30;

std::array<double, 3> Same(double value) { return {value, value, value}; }

std::array<double, 3> FirstThree(const std::vector<double>& values, double fallback) {
  std::array<double, 3> three = Same(fallback);
  for (size_t i = 0; i < 3 && values.size() >= 3; ++i) three[i] = values[i];
  return three;
}

GltfTextureUse UseOf(const tinygltf::TextureInfo& info) {
  return ReadTextureUse(info.index, info.texCoord, info.extensions);
}

}  // namespace

GltfSurfaceMaker::GltfSurfaceMaker(const tinygltf::Material& source, const GltfVertexData& data,
                                   const GltfUvFrames& frames, GltfTextures* textures,
                                   Diagnostics* diagnostics, Place place)
    : source_(source),
      data_(data),
      frames_(frames),
      textures_(*textures),
      diagnostics_(*diagnostics),
      place_(place) {}

GltfSurface GltfSurfaceMaker::Make(Material* material) {
  GltfSurface surface;
  surface.frames = frames_;
  WarnOfMissing();
  surface.alpha = ReadAlpha();
  if (Extension("KHR_materials_unlit") != nullptr) {
    MakeUnlit(&surface, material);
    return surface;
  }
  const auto& base = source_.pbrMetallicRoughness;
  const tinygltf::Value* transmission = Extension("KHR_materials_transmission");
  // Beside a texture the factor is 1, and says nothing of what the texture holds.
  const bool metal = base.metallicFactor >= 0.5 && base.metallicRoughnessTexture.index < 0;
  const bool solid = Closes() && !metal &&
                     NumberOf(transmission, "transmissionFactor", 0.0) > 0.5 &&
                     Member(transmission, "transmissionTexture") == nullptr;
  solid ? MakeGlass(material) : MakePrincipled(material);
  material->dispersion = static_cast<float>(
      std::max(0.0, NumberOf(Extension("KHR_materials_dispersion"), "dispersion", 0.0)));
  ReadNormals(material);
  const bool principled = std::string_view(kMaterialKinds[material->kind]->name) == "principled";
  surface.tangents = material->normal_map != kNoTexture || (principled && NeedsTangents());
  ReadEmission(&surface);
  return surface;
}

void GltfSurfaceMaker::ReadNormals(Material* material) {
  const tinygltf::NormalTextureInfo& normal = source_.normalTexture;
  const GltfTextureUse use = ReadTextureUse(normal.index, normal.texCoord, normal.extensions);
  material->normal_map =
      textures_.Node(use, {ImageUse::kColor, false, /*normals=*/true, normal.scale}, frames_);
  material->normal_map_follows_v = true;
}

bool GltfSurfaceMaker::NeedsTangents() const {
  const tinygltf::Value* coat = Extension("KHR_materials_clearcoat");
  const tinygltf::Value* anisotropy = Extension("KHR_materials_anisotropy");
  return Member(coat, "clearcoatNormalTexture") != nullptr ||
         NumberOf(anisotropy, "anisotropyStrength", 0.0) > 0.0;
}

const tinygltf::Value* GltfSurfaceMaker::Extension(const char* name) const {
  return FindExtension(source_.extensions, name);
}

uint32_t GltfSurfaceMaker::Texture(const GltfTextureUse& use, ImageUse channel, bool srgb) {
  return textures_.Node(use, {channel, srgb}, frames_);
}

GltfInput GltfSurfaceMaker::Number(const tinygltf::Value* extension, const char* name,
                                   double fallback, const char* texture, ImageUse channel) {
  return {Same(NumberOf(extension, name, fallback)),
          Texture(ReadTextureUse(extension, texture), channel, false)};
}

GltfInput GltfSurfaceMaker::Color(const tinygltf::Value* extension, const char* name,
                                  double fallback, const char* texture) {
  return {NumbersOf<3>(extension, name, Same(fallback)),
          Texture(ReadTextureUse(extension, texture), ImageUse::kColor, true)};
}

GltfInput GltfSurfaceMaker::BaseColor() {
  const auto& base = source_.pbrMetallicRoughness;
  GltfInput color{FirstThree(base.baseColorFactor, 1.0),
                  Texture(UseOf(base.baseColorTexture), ImageUse::kColor, true)};
  if (!data_.colors) return color;
  const uint32_t vertex = textures_.VertexColor(/*alpha=*/false);
  color.texture = color.texture == kNoTexture ? vertex : textures_.Product(color.texture, vertex);
  return color;
}

GltfInput GltfSurfaceMaker::Squared(const GltfInput& input) {
  GltfInput squared = input;
  for (double& factor : squared.factor) factor *= factor;
  if (input.texture != kNoTexture) {
    squared.texture = textures_.Product(input.texture, input.texture);
  }
  return squared;
}

void GltfSurfaceMaker::Set(Material* material, const char* parameter, const GltfInput& input) {
  SetColor(parameter, input.factor, material);
  const bool black = input.factor == Same(0.0);
  if (input.texture == kNoTexture || black) return;
  SetTexture(parameter, textures_.Scaled(input.texture, input.factor), material);
}

void GltfSurfaceMaker::MakePrincipled(Material* material) {
  *material = DefaultMaterial("principled");
  const auto& base = source_.pbrMetallicRoughness;
  const GltfTextureUse both = UseOf(base.metallicRoughnessTexture);
  Set(material, "base_color", BaseColor());
  Set(material, "metallic", {Same(base.metallicFactor), Texture(both, ImageUse::kBlue, false)});
  Set(material, "roughness", {Same(base.roughnessFactor), Texture(both, ImageUse::kGreen, false)});
  ReadTransmission(material);
  ReadSpecular(material);
  ReadClearcoat(material);
  ReadSheen(material);
  ReadAnisotropy(material);
}

void GltfSurfaceMaker::ReadTransmission(Material* material) {
  if (const tinygltf::Value* transmission = Extension("KHR_materials_transmission")) {
    Set(material, "transmission",
        Number(transmission, "transmissionFactor", 0.0, "transmissionTexture", ImageUse::kRed));
  }
}

void GltfSurfaceMaker::ReadSpecular(Material* material) {
  Set(material, "ior", {Same(NumberOf(Extension("KHR_materials_ior"), "ior", 1.5))});
  const tinygltf::Value* specular = Extension("KHR_materials_specular");
  if (specular == nullptr) return;
  Set(material, "specular",
      Number(specular, "specularFactor", 1.0, "specularTexture", ImageUse::kAlpha));
  Set(material, "specular_color",
      Color(specular, "specularColorFactor", 1.0, "specularColorTexture"));
}

void GltfSurfaceMaker::ReadClearcoat(Material* material) {
  const tinygltf::Value* coat = Extension("KHR_materials_clearcoat");
  if (coat == nullptr) return;
  Set(material, "clearcoat",
      Number(coat, "clearcoatFactor", 0.0, "clearcoatTexture", ImageUse::kRed));
  Set(material, "clearcoat_roughness",
      Number(coat, "clearcoatRoughnessFactor", 0.0, "clearcoatRoughnessTexture", ImageUse::kGreen));
  const GltfTextureUse normal = ReadTextureUse(coat, "clearcoatNormalTexture");
  const uint32_t node =
      textures_.Node(normal, {ImageUse::kColor, false, /*normals=*/true, normal.scale}, frames_);
  const bool coated = NumberOf(coat, "clearcoatFactor", 0.0) > 0.0;
  if (coated && (node != kNoTexture || source_.normalTexture.index >= 0)) {
    SetColor("clearcoat_normal", {0.5, 0.5, 1.0}, material);  // not that of the surface's map
  }
  if (coated && node != kNoTexture) SetTexture("clearcoat_normal", node, material);
}

void GltfSurfaceMaker::ReadSheen(Material* material) {
  const tinygltf::Value* sheen = Extension("KHR_materials_sheen");
  if (sheen == nullptr) return;
  Set(material, "sheen_color", Color(sheen, "sheenColorFactor", 0.0, "sheenColorTexture"));
  Set(material, "sheen_roughness",
      Number(sheen, "sheenRoughnessFactor", 0.0, "sheenRoughnessTexture", ImageUse::kAlpha));
}

void GltfSurfaceMaker::ReadAnisotropy(Material* material) {
  const tinygltf::Value* anisotropy = Extension("KHR_materials_anisotropy");
  if (anisotropy == nullptr) return;
  Set(material, "anisotropy",
      Number(anisotropy, "anisotropyStrength", 0.0, "anisotropyTexture", ImageUse::kBlue));
  SetNumber("anisotropy_rotation", NumberOf(anisotropy, "anisotropyRotation", 0.0), material);
  const GltfTextureUse use = ReadTextureUse(anisotropy, "anisotropyTexture");
  const uint32_t directions = Texture(use, ImageUse::kColor, false);
  if (directions != kNoTexture) SetTexture("anisotropy_direction", directions, material);
}

// The surface of a volume. The thickness itself is for those who do not trace light through it.
bool GltfSurfaceMaker::Closes() const {
  return NumberOf(Extension("KHR_materials_volume"), "thicknessFactor", 0.0) > 0.0;
}

std::array<float, 3> GltfSurfaceMaker::Absorption() const {
  std::array<float, 3> absorption{};
  const tinygltf::Value* volume = Extension("KHR_materials_volume");
  const double distance = NumberOf(volume, "attenuationDistance", 0.0);  // 0: not given, infinite
  const bool transmits =
      NumberOf(Extension("KHR_materials_transmission"), "transmissionFactor", 0.0) > 0.0;
  if (!Closes() || !transmits || !(distance > 0.0) || Extension("KHR_materials_unlit") != nullptr) {
    return absorption;
  }
  const auto left = NumbersOf<3>(volume, "attenuationColor", Same(1.0));
  for (size_t c = 0; c < 3; ++c) {
    // A channel of which nothing is left would have no finite one.
    const double share = std::clamp(left[c], double{std::numeric_limits<float>::min()}, 1.0);
    absorption[c] = static_cast<float>(std::min(-std::log(share) / distance, kMostAbsorption));
  }
  return absorption;
}

// Solid glass, which refracts. Light meets its surface twice on its way through: each time it is
// dyed with the root of the base colour.
void GltfSurfaceMaker::MakeGlass(Material* material) {
  *material = DefaultMaterial("dielectric");
  const auto& base = source_.pbrMetallicRoughness;
  GltfInput dye = BaseColor();
  for (double& factor : dye.factor) factor = std::sqrt(std::max(factor, 0.0));
  Set(material, "transmittance", dye);
  Set(material, "eta", {Same(NumberOf(Extension("KHR_materials_ior"), "ior", 1.5))});
  Set(material, "roughness",
      Squared({Same(base.roughnessFactor),
               Texture(UseOf(base.metallicRoughnessTexture), ImageUse::kGreen, false)}));
  Set(material, "remaproughness", {Same(0.0)});
}

// A picture of the base colour, whatever light falls on it.
void GltfSurfaceMaker::MakeUnlit(GltfSurface* surface, Material* material) {
  *material = DefaultMaterial("diffuse");
  Set(material, "reflectance", {Same(0.0)});
  const auto& base = source_.pbrMetallicRoughness;
  const std::array<double, 3> color = FirstThree(base.baseColorFactor, 1.0);
  surface->emission.emits = color != Same(0.0);
  surface->emission.two_sided = source_.doubleSided;
  for (size_t c = 0; c < 3; ++c) {
    surface->emission.radiance[c] = static_cast<float>(std::clamp(color[c], 0.0, 1.0));
  }
  const GltfTextureUse use = UseOf(base.baseColorTexture);
  surface->emission.image = textures_.Emission(use, frames_);
}

void GltfSurfaceMaker::ReadEmission(GltfSurface* surface) {
  const double strength =
      NumberOf(Extension("KHR_materials_emissive_strength"), "emissiveStrength", 1.0);
  const std::array<double, 3> factor = FirstThree(source_.emissiveFactor, 0.0);
  Emission& emission = surface->emission;
  for (size_t c = 0; c < 3; ++c) {
    const double radiance = factor[c] * strength;
    const bool usable = radiance > 0.0 && radiance <= kMostRadiance;
    emission.radiance[c] = usable ? static_cast<float>(radiance) : 0.0f;
    emission.emits = emission.emits || usable;
  }
  if (!emission.emits) return;
  emission.two_sided = source_.doubleSided;
  const GltfTextureUse use = UseOf(source_.emissiveTexture);
  emission.image = textures_.Emission(use, frames_);
}

uint32_t GltfSurfaceMaker::ReadAlpha() {
  const bool mask = source_.alphaMode == "MASK";
  if (!mask && source_.alphaMode != "BLEND") return kNoTexture;
  const auto& base = source_.pbrMetallicRoughness;
  const double factor = base.baseColorFactor.size() == 4 ? base.baseColorFactor[3] : 1.0;
  uint32_t node = Texture(UseOf(base.baseColorTexture), ImageUse::kAlpha, false);
  if (data_.colors) {
    const uint32_t vertex = textures_.VertexColor(/*alpha=*/true);
    node = node == kNoTexture ? vertex : textures_.Product(node, vertex);
  }
  if (node == kNoTexture) {
    const double opacity = mask ? (factor >= source_.alphaCutoff ? 1.0 : 0.0) : factor;
    return opacity >= 1.0 ? kNoTexture : textures_.Constant(Same(std::max(opacity, 0.0)));
  }
  node = textures_.Scaled(node, Same(factor));
  return mask ? textures_.Step(node, source_.alphaCutoff) : node;
}

void GltfSurfaceMaker::WarnOfMissing() {
  const auto warn = [&](const char* extension, const char* what) {
    if (Extension(extension) != nullptr) diagnostics_.Warn(place_, extension + std::string(what));
  };
  warn("KHR_materials_iridescence", " is not supported; surfaces are rendered without thin films");
  warn("KHR_materials_dispersion",
       " is kept but has no effect in RGB; glass refracts all colours alike");
  warn("KHR_materials_pbrSpecularGlossiness",
       " is not supported; the metallic-roughness parameters are used");
}

}  // namespace swell
