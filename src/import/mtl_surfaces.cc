// Chooses the kind of material by what an MTL material says, and translates its numbers.
#include "src/import/mtl_surfaces.h"

#include <algorithm>
#include <cmath>

#include "src/import/material_words.h"
#include "src/import/materials.h"

namespace swell {
namespace {

using Color = std::array<double, 3>;

constexpr double kClay = 0.6;         // reflectance where nothing is said
constexpr double kBumpHeight = 0.01;  // of white at -bm 1, of the model's size
constexpr double kGlassIndex = 1.5;   // where Ni is not given
constexpr double kLeastGlassIndex = 1.0001;

Color ToColor(const tinyobj::real_t (&c)[3]) { return {c[0], c[1], c[2]}; }
double Most(const Color& c) { return std::max({c[0], c[1], c[2]}); }

// Kd; white under a texture if it is black or not given, as exporters that write map_Kd mean it.
Color BaseColor(const MtlMaterial& mtl) {
  const Color given = ToColor(mtl.values.diffuse);
  const bool textured = !mtl.values.diffuse_texname.empty();
  if (mtl.Has("Kd") && !(textured && Most(given) <= 0.0)) return given;
  if (textured) return {1, 1, 1};
  return mtl.Has("Ke") ? Color{} : Color{kClay, kClay, kClay};
}

double IndexOf(const MtlMaterial& mtl) {
  return mtl.Has("Ni") && mtl.values.ior > kLeastGlassIndex ? mtl.values.ior : kGlassIndex;
}

// Blinn's exponent to GGX's alpha (alpha^2 = 2 / (Ns + 2), Walter et al. 2007, section 5.3), whose
// root is the principled material's roughness.
double PhongAlpha(const MtlMaterial& mtl) {
  return std::sqrt(2.0 / (std::max(0.0, double{mtl.values.shininess}) + 2.0));
}

bool IsPbr(const MtlMaterial& mtl) {
  for (std::string_view name : {"Pr", "Pm", "Ps", "Pc", "map_Pr", "map_Pm", "map_Ps"}) {
    if (mtl.Has(name)) return true;
  }
  return false;
}

// The illumination models with "transparency: glass on" or "refraction on".
bool IsGlass(const MtlMaterial& mtl) {
  const int illum = mtl.values.illum;
  const bool glass = illum == 4 || illum == 6 || illum == 7 || illum == 9;
  const bool filter =
      (mtl.Has("Tf") || mtl.Has("Kt")) && Most(ToColor(mtl.values.transmittance)) > 0.0;
  return glass && (mtl.values.dissolve < 1.0 || filter);
}

}  // namespace

Material ClayMaterial() {
  Material clay = DefaultMaterial("diffuse");
  SetNumber("reflectance", kClay, &clay);
  return clay;
}

void MtlSurfaces::SetBaseColor(std::string_view parameter, const MtlMaterial& mtl,
                               Material* material) {
  const Color color = BaseColor(mtl);
  if (Most(color) > 1.0) {
    diagnostics_.Warn(mtl.place, "Kd above 1 counts as 1; surfaces reflect no more than they get");
  }
  SetColor(parameter, color, material);
  if (mtl.values.diffuse_texname.empty()) return;
  const uint32_t node =
      textures_.Node({mtl.values.diffuse_texname, mtl.values.diffuse_texopt, mtl.place},
                     MtlImageUse::kColor, color);
  if (node != kNoTexture) SetTexture(parameter, node, material);
}

void MtlSurfaces::VaryBy(const std::string& name, const tinyobj::texture_option_t& options,
                         const MtlMaterial& mtl, std::string_view parameter, double factor,
                         Material* material) {
  if (name.empty()) return;
  const uint32_t node =
      textures_.Node({name, options, mtl.place}, MtlImageUse::kNumber, {factor, factor, factor});
  if (node != kNoTexture) SetTexture(parameter, node, material);
}

Material MtlSurfaces::MakePbr(const MtlMaterial& mtl) {
  const tinyobj::material_t& v = mtl.values;
  Material material = DefaultMaterial("principled");
  SetBaseColor("base_color", mtl, &material);
  const double metallic = mtl.Has("Pm") ? v.metallic : mtl.Has("map_Pm") ? 1.0 : 0.0;
  const double roughness = mtl.Has("Pr")       ? v.roughness
                           : mtl.Has("map_Pr") ? 1.0
                           : mtl.Has("Ns")     ? std::sqrt(PhongAlpha(mtl))
                                               : 0.5;
  const double sheen = mtl.Has("Ps") ? v.sheen : mtl.Has("map_Ps") ? 1.0 : 0.0;
  SetNumber("metallic", metallic, &material);
  SetNumber("roughness", roughness, &material);
  SetNumber("ior", IndexOf(mtl), &material);
  SetNumber("sheen_color", sheen, &material);
  SetNumber("sheen_roughness", sheen > 0.0 ? 0.3 : 0.0, &material);
  SetNumber("clearcoat", v.clearcoat_thickness, &material);
  SetNumber("clearcoat_roughness", v.clearcoat_roughness, &material);
  VaryBy(v.metallic_texname, v.metallic_texopt, mtl, "metallic", metallic, &material);
  VaryBy(v.roughness_texname, v.roughness_texopt, mtl, "roughness", roughness, &material);
  VaryBy(v.sheen_texname, v.sheen_texopt, mtl, "sheen_color", sheen, &material);
  return material;
}

// Where rays are refracted, the surface bounds a body of glass; else it is a pane.
Material MtlSurfaces::MakeGlass(const MtlMaterial& mtl) {
  const int illum = mtl.values.illum;
  const bool body = illum == 6 || illum == 7;
  const Color filter = ToColor(mtl.values.transmittance);
  const bool tinted = Most(filter) > 0.0;
  if (body) {
    Material material = DefaultMaterial("dielectric");
    SetNumber("eta", IndexOf(mtl), &material);
    // Light crosses the surface twice.
    if (tinted) {
      SetColor("transmittance",
               {std::sqrt(std::max(0.0, filter[0])), std::sqrt(std::max(0.0, filter[1])),
                std::sqrt(std::max(0.0, filter[2]))},
               &material);
    }
    return material;
  }
  Material material = DefaultMaterial("principled");
  SetColor("base_color", tinted ? filter : Color{1, 1, 1}, &material);
  SetNumber("metallic", 0.0, &material);
  SetNumber("roughness", 0.0, &material);
  SetNumber("ior", IndexOf(mtl), &material);
  SetNumber("transmission", 1.0, &material);
  return material;
}

// Ks as most exporters mean it: 0.5 is a dielectric of index 1.5, which reflects 4 % head on.
Material MtlSurfaces::MakePhong(const MtlMaterial& mtl) {
  const Color specular = ToColor(mtl.values.specular), base = BaseColor(mtl);
  const bool textured = !mtl.values.diffuse_texname.empty();
  const bool shiny = Most(specular) > 0.0 && !(mtl.Has("illum") && mtl.values.illum < 2);
  if (!shiny) {
    Material material = DefaultMaterial("diffuse");
    SetBaseColor("reflectance", mtl, &material);
    return material;
  }
  const double alpha = PhongAlpha(mtl);
  if (Most(base) <= 0.0 && !textured) {
    const bool mirror = mtl.values.illum == 3 || mtl.values.illum == 5;
    Material material = DefaultMaterial("conductor");
    SetColor("reflectance", specular, &material);
    SetNumber("roughness", mirror ? 0.0 : alpha, &material);
    SetNumber("remaproughness", 0.0, &material);
    return material;
  }
  Material material = DefaultMaterial("principled");
  SetBaseColor("base_color", mtl, &material);
  const double weight = std::min(1.0, 2.0 * Most(specular));
  SetNumber("metallic", 0.0, &material);
  SetNumber("roughness", std::sqrt(alpha), &material);
  SetNumber("ior", kGlassIndex, &material);
  SetNumber("specular", weight, &material);
  SetColor("specular_color",
           {2.0 * specular[0] / weight, 2.0 * specular[1] / weight, 2.0 * specular[2] / weight},
           &material);
  VaryBy(mtl.values.specular_texname, mtl.values.specular_texopt, mtl, "specular", weight,
         &material);
  return material;
}

void MtlSurfaces::AddRelief(const MtlMaterial& mtl, Material* material) {
  const tinyobj::material_t& v = mtl.values;
  if (!v.normal_texname.empty()) {
    material->normal_map =
        textures_.NormalMap({v.normal_texname, v.normal_texopt, mtl.place}, MtlImageUse::kNormal);
    return;
  }
  if (v.bump_texname.empty()) return;
  const MtlTexture bump = {v.bump_texname, v.bump_texopt, mtl.place};
  const uint32_t image = textures_.Image(bump, MtlImageUse::kHeight);
  if (image == kNoTexture) return;
  if (textures_.HoldsNormals(image)) {
    material->normal_map = textures_.NormalMap(bump, MtlImageUse::kHeight);
    return;
  }
  const double height = kBumpHeight * size_ * v.bump_texopt.bump_multiplier;
  material->displacement = textures_.Node(bump, MtlImageUse::kHeight, {height, height, height});
}

uint32_t MtlSurfaces::Opacity(const MtlMaterial& mtl) {
  const double opacity = std::clamp<double>(mtl.values.dissolve, 0.0, 1.0);
  if (opacity == 0.0) {
    diagnostics_.Warn(mtl.place,
                      "material " + Quote(mtl.values.name) +
                          " cannot be seen: its d is 0, or its Tr is 1; if it should be solid, "
                          "remove that line");
  }
  if (!mtl.values.alpha_texname.empty()) {
    const uint32_t node =
        textures_.Node({mtl.values.alpha_texname, mtl.values.alpha_texopt, mtl.place},
                       MtlImageUse::kNumber, {opacity, opacity, opacity});
    if (node != kNoTexture) return node;
  }
  return opacity < 1.0 ? textures_.Constant({opacity, opacity, opacity}) : kNoTexture;
}

Emission MtlSurfaces::MakeEmission(const MtlMaterial& mtl) {
  Emission emission;
  Color radiance = ToColor(mtl.values.emission);
  if (!mtl.values.emissive_texname.empty()) {
    emission.image = textures_.Image(
        {mtl.values.emissive_texname, mtl.values.emissive_texopt, mtl.place}, MtlImageUse::kLight);
    if (emission.image != kNoTexture && Most(radiance) <= 0.0) radiance = {1, 1, 1};
  }
  for (size_t c = 0; c < 3; ++c) {
    emission.radiance[c] = static_cast<float>(std::max(0.0, radiance[c]));
  }
  emission.emits = Most(radiance) > 0.0;
  emission.two_sided = true;  // MTL knows no sides
  return emission;
}

MtlSurface MtlSurfaces::Make(const MtlMaterial& mtl) {
  MtlSurface surface;
  const bool glass = IsGlass(mtl);
  Material material = glass ? MakeGlass(mtl) : IsPbr(mtl) ? MakePbr(mtl) : MakePhong(mtl);
  material.name = mtl.values.name;
  AddRelief(mtl, &material);
  surface.alpha = glass ? kNoTexture : Opacity(mtl);
  surface.emission = MakeEmission(mtl);
  surface.material = static_cast<uint32_t>(scene_.materials.size());
  scene_.materials.push_back(std::move(material));
  return surface;
}

}  // namespace swell
