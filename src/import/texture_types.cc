// The parameters of each type of texture, with pbrt-v4's names and defaults.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "src/base/suggest.h"
#include "src/import/textures.h"

namespace swell {
namespace {

constexpr int32_t kMaxOctaves = 32;

// One of a few words; the first is the default.
template <class T> struct Word {
  std::string_view name;
  T value;
};
template <class T, size_t N>
T ReadWord(Parameters& parameters, std::string_view name, const Word<T> (&words)[N], T fallback) {
  const Parameter* parameter = parameters.Any(name);
  const std::string word = parameters.String(name, "");
  if (parameter == nullptr || parameters.failed()) return fallback;
  std::vector<std::string_view> names;
  for (const Word<T>& known : words) {
    if (known.name == word) return known.value;
    names.push_back(known.name);
  }
  parameters.Fail(parameter->place,
                  parameter->Title() + ": unknown value " + Quote(word) + KnownWords(word, names));
  return fallback;
}

Encoding ReadEncoding(Parameters& parameters) {
  Encoding encoding;
  const Parameter* parameter = parameters.Any("encoding");
  const std::string text = parameters.String("encoding", "sRGB");
  if (parameter == nullptr || parameters.failed() || text == "sRGB") return encoding;
  if (text == "linear") {
    encoding.curve = Encoding::Curve::kLinear;
    return encoding;
  }
  encoding.curve = Encoding::Curve::kGamma;
  encoding.gamma = text.rfind("gamma ", 0) == 0 ? std::strtof(text.c_str() + 6, nullptr) : 0.0f;
  if (!(encoding.gamma > 0.0f && encoding.gamma <= 100.0f)) {
    parameters.Fail(parameter->place, parameter->Title() + ": unknown value " + Quote(text) +
                                          " (known: sRGB, linear, gamma NUMBER)");
  }
  return encoding;
}

}  // namespace

const TextureNames::Type* TextureNames::FindType(std::string_view name) {
  using N = TextureNames;
  static constexpr Type kTypes[] = {
      {"constant", TextureOp::kConstant, &N::ReadConstant},
      {"scale", TextureOp::kScale, &N::ReadScale},
      {"mix", TextureOp::kMix, &N::ReadMix},
      {"directionmix", TextureOp::kDirectionMix, &N::ReadDirectionMix},
      {"bilerp", TextureOp::kBilerp, &N::ReadBilerp},
      {"imagemap", TextureOp::kImage, &N::ReadImagemap},
      {"checkerboard", TextureOp::kCheckerboard2, &N::ReadCheckerboard},
      {"dots", TextureOp::kDots, &N::ReadDots},
      {"fbm", TextureOp::kFbm, &N::ReadNoise},
      {"wrinkled", TextureOp::kWrinkled, &N::ReadNoise},
      {"windy", TextureOp::kWindy, &N::ReadNoise},
      {"marble", TextureOp::kMarble, &N::ReadNoise},
  };
  const auto found = std::find_if(std::begin(kTypes), std::end(kTypes),
                                  [&](const Type& type) { return type.name == name; });
  return found == std::end(kTypes) ? nullptr : found;
}

std::vector<std::string_view> TextureNames::TypeNames() {
  return {"constant",     "scale", "mix", "directionmix", "bilerp", "imagemap",
          "checkerboard", "dots",  "fbm", "wrinkled",     "windy",  "marble"};
}

void TextureNames::ReadConstant(Parameters& parameters, TextureKind kind, const Transform&,
                                TextureStep* step) {
  Parameter* parameter = parameters.Any("value");
  const std::array<float, 3> value =
      parameter == nullptr ? std::array<float, 3>{1, 1, 1} : Value(parameters, *parameter, kind);
  std::copy(value.begin(), value.end(), step->value);
}

void TextureNames::ReadScale(Parameters& parameters, TextureKind kind, const Transform&,
                             TextureStep* step) {
  step->input[0] = Input(parameters, "tex", kind, 1.0f);
  step->input[1] = Input(parameters, "scale", TextureKind::kFloat, 1.0f);
}

void TextureNames::ReadMix(Parameters& parameters, TextureKind kind, const Transform&,
                           TextureStep* step) {
  step->input[0] = Input(parameters, "tex1", kind, 0.0f);
  step->input[1] = Input(parameters, "tex2", kind, 1.0f);
  step->input[2] = Input(parameters, "amount", TextureKind::kFloat, 0.5f);
}

void TextureNames::ReadDirectionMix(Parameters& parameters, TextureKind kind,
                                    const Transform& to_world, TextureStep* step) {
  step->input[0] = Input(parameters, "tex1", kind, 0.0f);
  step->input[1] = Input(parameters, "tex2", kind, 1.0f);
  const Parameter* dir = parameters.Floats("dir", {"vector3", "vector"}, 3, 3);
  const Point in_texture =
      dir == nullptr ? Point{0, 1, 0} : Point{dir->floats[0], dir->floats[1], dir->floats[2]};
  const auto world = Normalized(MapVector(to_world, in_texture));
  if (!world) return parameters.Fail(parameters.place(), "\"dir\" has no direction");
  for (size_t c = 0; c < 3; ++c) step->value[c] = static_cast<float>((*world)[c]);
}

void TextureNames::ReadBilerp(Parameters& parameters, TextureKind kind, const Transform& to_world,
                              TextureStep* step) {
  ReadMapping(parameters, to_world, step);
  float* value = step->value;
  for (const auto& [name, fallback] :
       {std::pair{"v00", 0.0f}, {"v01", 1.0f}, {"v10", 0.0f}, {"v11", 1.0f}}) {
    Parameter* parameter = parameters.Any(name);
    const std::array<float, 3> color = parameter == nullptr
                                           ? std::array<float, 3>{fallback, fallback, fallback}
                                           : Value(parameters, *parameter, kind);
    value = std::copy(color.begin(), color.end(), value);
  }
}

void TextureNames::ReadImagemap(Parameters& parameters, TextureKind kind, const Transform& to_world,
                                TextureStep* step) {
  static constexpr Word<TextureWrap> kWraps[] = {{"repeat", TextureWrap::kRepeat},
                                                 {"black", TextureWrap::kBlack},
                                                 {"clamp", TextureWrap::kClamp},
                                                 {"octahedralsphere", TextureWrap::kOctahedral}};
  static constexpr Word<TextureFilter> kFilters[] = {{"point", TextureFilter::kPoint},
                                                     {"bilinear", TextureFilter::kBilinear},
                                                     {"trilinear", TextureFilter::kTrilinear},
                                                     {"ewa", TextureFilter::kTrilinear},
                                                     {"EWA", TextureFilter::kTrilinear}};
  ReadMapping(parameters, to_world, step);
  step->wrap = ReadWord(parameters, "wrap", kWraps, TextureWrap::kRepeat);
  step->filter = ReadWord(parameters, "filter", kFilters, TextureFilter::kBilinear);
  const std::string filter = parameters.String("filter", "");
  if (filter == "ewa" || filter == "EWA") {
    parameters.Warn(parameters.Any("filter")->place,
                    "the filter 'EWA' is not supported; 'trilinear' replaces it");
  }
  parameters.Accept({"maxanisotropy"});
  step->value[0] = parameters.FloatWithin("scale", 1.0f, 0.0f, 1e30f);
  step->invert = parameters.Bool("invert", false) ? 1 : 0;
  const Encoding encoding = ReadEncoding(parameters);
  const Parameter* file = parameters.Any("filename");
  if (file == nullptr) {
    return parameters.Fail(parameters.place(), "\"string filename\" is missing");
  }
  step->image = Image(parameters, *file, kind, encoding);
}

void TextureNames::ReadCheckerboard(Parameters& parameters, TextureKind kind,
                                    const Transform& to_world, TextureStep* step) {
  if (parameters.IntWithin("dimension", 2, 2, 3) == 3) step->op = TextureOp::kCheckerboard3;
  ReadMapping(parameters, to_world, step);
  step->input[0] = Input(parameters, "tex1", kind, 1.0f);
  step->input[1] = Input(parameters, "tex2", kind, 0.0f);
}

void TextureNames::ReadDots(Parameters& parameters, TextureKind kind, const Transform& to_world,
                            TextureStep* step) {
  ReadMapping(parameters, to_world, step);
  step->input[0] = Input(parameters, "inside", kind, 1.0f);
  step->input[1] = Input(parameters, "outside", kind, 0.0f);
}

void TextureNames::ReadNoise(Parameters& parameters, TextureKind, const Transform& to_world,
                             TextureStep* step) {
  ReadMapping(parameters, to_world, step);
  if (step->op == TextureOp::kWindy) return;
  const int32_t octaves = parameters.IntWithin("octaves", 8, 1, kMaxOctaves);
  step->octaves = static_cast<uint32_t>(std::clamp(octaves, 1, kMaxOctaves));
  step->value[0] = parameters.FloatWithin("roughness", 0.5f, 0.0f, 10.0f);
  if (step->op != TextureOp::kMarble) return;
  step->value[1] = parameters.Float("scale", 1.0f);
  step->value[2] = parameters.Float("variation", 0.2f);
}

// How points become texture coordinates; textures of space use the inverse transform alone.
void TextureNames::ReadMapping(Parameters& parameters, const Transform& to_world,
                               TextureStep* step) {
  static constexpr Word<TextureMapping> kMappings[] = {
      {"uv", TextureMapping::kUv},
      {"spherical", TextureMapping::kSpherical},
      {"cylindrical", TextureMapping::kCylindrical},
      {"planar", TextureMapping::kPlanar}};
  step->mapping = ReadWord(parameters, "mapping", kMappings, TextureMapping::kUv);
  const float u_delta = parameters.Float("udelta", 0.0f);
  const float v_delta = parameters.Float("vdelta", 0.0f);
  const float u_scale = parameters.Float("uscale", 1.0f);
  const float v_scale = parameters.Float("vscale", 1.0f);
  const Parameter* v1 = parameters.Floats("v1", {"vector3", "vector"}, 3, 3);
  const Parameter* v2 = parameters.Floats("v2", {"vector3", "vector"}, 3, 3);
  if (step->mapping == TextureMapping::kPlanar) {
    const float planes[8] = {1, 0, 0, 0, 1, 0, u_delta, v_delta};
    std::copy(planes, planes + 8, step->map);
    if (v1 != nullptr) std::copy(v1->floats.begin(), v1->floats.end(), step->map);
    if (v2 != nullptr) std::copy(v2->floats.begin(), v2->floats.end(), step->map + 3);
  } else {
    const float map[4] = {u_scale, v_scale, u_delta, v_delta};
    std::copy(map, map + 4, step->map);
  }
  const auto inverse = Inverse(to_world);
  if (!inverse) {
    return parameters.Fail(parameters.place(),
                           "the transform is singular; it flattens the texture");
  }
  const Affine from_world = ToAffine(*inverse);
  std::copy(from_world.begin(), from_world.end(), step->texture_from_world);
  double longest = 0.0;
  for (size_t c = 0; c < 3; ++c) {
    longest = std::max(longest, std::hypot(inverse->m[c], inverse->m[c + 4], inverse->m[c + 8]));
  }
  step->scale_from_world = static_cast<float>(longest);
}

}  // namespace swell
