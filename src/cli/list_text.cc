// Materials from their registry; lights and shapes as the scene readers take them.
#include "src/cli/list_text.h"

#include <cstdio>

#include "src/cli/list_entries.h"

namespace swell {
namespace {

std::string Number(float value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.6g", static_cast<double>(value));
  return text;
}

const char* TypeName(const ParamSpec& param) {
  switch (param.type) {
    case ParamType::kRgb:
      return "rgb ";
    case ParamType::kChoice:
      return "string ";
    case ParamType::kBool:
      return "bool ";
    case ParamType::kInt:
      return "integer ";
    case ParamType::kFloat:
      break;
  }
  return "float ";
}

std::string FallbackText(const ParamSpec& param) {
  if (param.type == ParamType::kRgb) {
    return Number(param.fallback[0]) + " " + Number(param.fallback[1]) + " " +
           Number(param.fallback[2]);
  }
  if (param.type == ParamType::kBool) return param.fallback[0] != 0.0f ? "true" : "false";
  if (param.type == ParamType::kChoice) {
    for (uint32_t i = 0; i < param.named_count; ++i) {
      if (param.named[i].value[0] == param.fallback[0]) return param.named[i].name;
    }
  }
  return Number(param.fallback[0]);
}

std::string NamesText(const ParamSpec& param) {
  std::string text, line;
  for (uint32_t i = 0; i < param.named_count; ++i) {
    const std::string name = param.named[i].name;
    if (line.size() + name.size() > 72) {
      text += "        " + line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + name + (i + 1 < param.named_count ? "," : "");
  }
  return text + "        " + line + "\n";
}

// Materials that have no kernel of their own.
constexpr const char* kMadeByTheImporter =
    "interface\n"
    "  no surface at all: light passes it unchanged and uncounted (also \"none\")\n"
    "mix\n"
    "  two materials in one surface: each hit is of one of them\n"
    "    string materials            two names\n"
    "    float amount                0.5                     0 to 1        share of the second\n";

}  // namespace

std::string MaterialsText(std::span<const MaterialInfo* const> kinds) {
  std::string text =
      "Name, then its parameters: type, default, range, meaning, named values. Rough\n"
      "surfaces are GGX microfacets without compensation of multiple scattering: they\n"
      "lose some light, as pbrt-v4's do.\n\n";
  for (const MaterialInfo* kind : kinds) {
    text += std::string(kind->name) + "\n  " + kind->help + "\n";
    for (uint32_t i = 0; i < kind->param_count; ++i) {
      const ParamSpec& param = kind->params[i];
      const bool ranged = param.type != ParamType::kChoice;
      text += "    " + Padded(std::string(TypeName(param)) + param.name, 28) +
              Padded(FallbackText(param), 24) +
              Padded(ranged ? Number(param.min) + " to " + Number(param.max) : "", 14) +
              param.help + "\n";
      if (param.named_count > 0) text += NamesText(param);
    }
  }
  return text + kMadeByTheImporter;
}

std::string LightsText() {
  static const Param kScale{"float scale", "1", "multiplies the colour"};
  static const std::vector<Entry> kLights{
      {"infinite",
       "LightSource: the same radiance from every direction (sky, background)",
       {{"rgb L", "1 1 1", "radiance; also blackbody, spectrum"},
        kScale,
        {"float illuminance", "unset", "of a plane that faces the sky, instead of L's brightness"},
        {"string filename", "none",
         "radiance by an image instead of L, z up: square (equal-area map) or 2:1 (latitude-"
         "longitude)"}}},
      {"point",
       "LightSource: the same intensity in every direction",
       {{"rgb I", "1 1 1", "intensity; also blackbody, spectrum"},
        kScale,
        {"float power", "unset", "total power, instead of I's brightness"},
        {"point3 from", "0 0 0", "position"}}},
      {"spot",
       "LightSource: a cone of light that fades towards its edge",
       {{"rgb I", "1 1 1", "intensity in the middle; also blackbody, spectrum"},
        kScale,
        {"float power", "unset", "total power, instead of I's brightness"},
        {"point3 from", "0 0 0", "position"},
        {"point3 to", "0 0 1", "shines there"},
        {"float coneangle", "30", "degrees from the axis to the edge"},
        {"float conedeltaangle", "5", "degrees over which it fades"}}},
      {"goniometric",
       "LightSource: a point that shines by an image of its directions",
       {{"string filename", "", "square or 2:1, as of infinite; y is the image's up"},
        {"rgb I", "1 1 1", "multiplies the image; also blackbody, spectrum"},
        kScale,
        {"float power", "unset", "total power, instead of the image's"}}},
      {"projection",
       "LightSource: a slide projector that looks along z",
       {{"string filename", "", "the slide"},
        {"float fov", "90", "degrees over the shorter side"},
        kScale,
        {"float power", "unset", "total power, instead of the image's"}}},
      {"distant",
       "LightSource: parallel rays, as from the sun",
       {{"rgb L", "1 1 1", "irradiance on a facing plane; also blackbody, spectrum"},
        kScale,
        {"float illuminance", "unset", "on a facing plane, instead of L's brightness"},
        {"point3 from", "0 0 0", "the rays go from here"},
        {"point3 to", "0 0 1", "to here"}}},
      {"diffuse",
       "AreaLightSource: every shape that follows emits the same radiance in all directions",
       {{"rgb L", "1 1 1", "radiance; also blackbody, spectrum; may be above 1"},
        kScale,
        {"float power", "unset", "of each shape, instead of L's brightness"},
        {"bool twosided", "false", "emits on both sides"},
        {"string filename", "none", "radiance by an image over u and v instead of L"}}},
  };
  return "Name, then its parameters: type and name, default, meaning. Which light a shaded point\n"
         "draws is up to --lightsampler, or the Integrator's \"string lightsampler\".\n\n" +
         EntriesText(kLights);
}

std::string TexturesText() {
  // What the mapped textures share.
  static const std::vector<Param> kMapping{
      {"string mapping", "uv", "uv, spherical, cylindrical or planar (the latter in space)"},
      {"float uscale, vscale", "1", "repeats of u and v, for uv"},
      {"float udelta, vdelta", "0", "offsets, for uv and planar"},
      {"vector3 v1, v2", "x, y", "of planar: whose multiples are s and t"}};
  static const auto with = [](std::vector<Param> params) {
    params.insert(params.end(), kMapping.begin(), kMapping.end());
    return params;
  };
  static const std::vector<Param> kOctaves{{"integer octaves", "8", "1 to 32"},
                                           {"float roughness", "0.5", "weight of each octave"}};
  static const std::vector<Entry> kTextures{
      {"constant", "the same everywhere", {{"value", "1", "number or colour"}}},
      {"scale", "a product", {{"tex", "1", ""}, {"float scale", "1", "number or texture"}}},
      {"mix",
       "from one texture to another",
       {{"tex1", "0", "at amount 0"}, {"tex2", "1", "at amount 1"}, {"float amount", "0.5", ""}}},
      {"directionmix",
       "by the cosine between normal and direction",
       {{"tex1", "0", "where they agree"},
        {"tex2", "1", "where they are at right angles"},
        {"vector3 dir", "0 1 0", ""}}},
      {"bilerp", "between four values",
       with({{"v00, v01, v10, v11", "0 1 0 1", "at (s, t) = (0, 0), (0, 1), (1, 0), (1, 1)"}})},
      {"imagemap", "an image: any format of OpenImageIO",
       with({{"string filename", "", "relative to the scene file"},
             {"string wrap", "repeat", "repeat, black, clamp or octahedralsphere"},
             {"string filter", "bilinear", "point, bilinear or trilinear"},
             {"string encoding", "sRGB", "of integer formats: sRGB, linear or 'gamma NUMBER'"},
             {"float scale", "1", "multiplies the image"},
             {"bool invert", "false", "one less the image"}})},
      {"checkerboard", "squares or cubes of side 1",
       with({{"tex1", "1", ""}, {"tex2", "0", ""}, {"integer dimension", "2", "2 or 3"}})},
      {"dots", "round spots here and there", with({{"inside", "1", ""}, {"outside", "0", ""}})},
      {"fbm", "noise in octaves, in space", kOctaves},
      {"wrinkled", "magnitudes of noise in octaves, in space", kOctaves},
      {"windy", "waves on water, in space", {}},
      {"marble",
       "stone, in space",
       {{"integer octaves", "8", "1 to 32"},
        {"float roughness", "0.5", "weight of each octave"},
        {"float scale", "1", "of space"},
        {"float variation", "0.2", "of the veins"}}},
  };
  return "Texture \"name\" \"float\" or \"spectrum\" \"type\" parameters. Types, then their "
         "parameters: name,\ndefault, meaning. Values without a type are numbers, colours or "
         "textures of the texture's kind.\n\n" +
         EntriesText(kTextures);
}

std::string ShapesText() {
  static const std::vector<Param> kMesh{
      {"point3 P", "", "vertices"},
      {"integer indices", "", "vertices of each face; may be absent for a single one"},
      {"normal N", "none", "a normal for each vertex"},
      {"point2 uv", "none", "texture coordinates for each vertex"}};
  static const std::vector<Entry> kShapes{
      {"sphere",
       "analytic, under any affine transform; parts of one become triangles",
       {{"float radius", "1", "object space"},
        {"float zmin", "-radius", "cuts below"},
        {"float zmax", "radius", "cuts above"},
        {"float phimax", "360", "degrees around z"}}},
      {"trianglemesh", "triangles", kMesh},
      {"plymesh",
       "triangles of a PLY file: ASCII or binary of either order, or packed by gzip; quads are "
       "split",
       {{"string filename", "", "relative to the scene file"}}},
      {"disk",
       "as triangles",
       {{"float height", "0", "along z"},
        {"float radius", "1", "object space"},
        {"float innerradius", "0", "of the hole"},
        {"float phimax", "360", "degrees around z"}}},
      {"bilinearmesh", "patches of four vertices (00 10 01 11), as triangles", kMesh},
      {"cylinder",
       "as triangles, open at both ends",
       {{"float radius", "1", "object space"},
        {"float zmin", "-1", "where it begins"},
        {"float zmax", "1", "where it ends"},
        {"float phimax", "360", "degrees around z"}}},
      {"curve",
       "as triangles within 2 % of the width; flat ones are tubes",
       {{"point3 P", "", "control points"},
        {"string type", "flat", "flat, cylinder or ribbon"},
        {"string basis", "bezier", "bezier or bspline"},
        {"integer degree", "3", "2 or 3"},
        {"float width", "1", "object space; width0 and width1 for its ends"},
        {"normal N", "none", "of a ribbon: one for each segment and one more"}}},
      {"loopsubdiv",
       "limit surface of Loop's subdivision, as triangles",
       {{"point3 P", "", "control points"},
        {"integer indices", "", "vertices of each triangle"},
        {"integer levels", "3", "each makes four triangles of one"}}},
  };
  return "Name, then its parameters: type and name, default, meaning.\n\n" + EntriesText(kShapes);
}

std::string IsasText(const std::vector<IsaInfo>& isas) {
  std::string text =
      "Name, lanes of a vector, whether it works here. 'auto' takes the first that does. Sets "
      "with\n"
      "fused multiply-add give the same picture to the bit, the others within noise.\n\n";
  for (const IsaInfo& isa : isas) {
    const char* state = !isa.built         ? "not in this build"
                        : isa.cpu_supports ? "yes"
                                           : "not this CPU";
    text += "  " + Padded(isa.name, 8) + Padded(std::to_string(isa.lanes) + " lanes", 10) +
            Padded(state, 19) + Padded(isa.fused ? "fused" : "not fused", 11) + isa.help + "\n";
  }
  return text;
}

}  // namespace swell
