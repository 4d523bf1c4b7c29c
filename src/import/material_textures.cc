// Parameters of type "texture" -> what FinishScene makes programs of.
#include "src/import/material_textures.h"

#include <algorithm>

#include "src/import/textures.h"

namespace swell {
namespace {

// Heights by a texture, or normals by an image.
void ReadHeights(Parameters& parameters, Material* material) {
  const Parameter* displacement = parameters.Any("displacement");
  const Parameter* map = parameters.Any("normalmap");
  if (displacement != nullptr && displacement->type == "texture") {
    material->displacement =
        parameters.textures()->Find(parameters, *displacement, TextureKind::kFloat);
  } else if (displacement != nullptr && displacement->type != "float") {
    parameters.FailType(*displacement, "texture");
  }
  if (map == nullptr) return;
  if (displacement != nullptr) {
    return parameters.Fail(map->place,
                           "\"displacement\" and \"normalmap\" are both given; "
                           "remove one of the two");
  }
  Encoding linear;
  linear.curve = Encoding::Curve::kLinear;
  const uint32_t image =
      parameters.textures()->Image(parameters, *map, TextureKind::kSpectrum, linear);
  if (!parameters.failed()) material->normal_map = parameters.textures()->NormalMap(image);
}

// One program computes all the textures of a material.
void CheckTextures(Parameters& parameters, const Material& material) {
  size_t steps = 0;
  for (const MaterialTexture& texture : material.textures) {
    steps += parameters.textures()->StepCount(texture.node);
  }
  if (material.displacement != kNoTexture) {
    steps = std::max(steps, parameters.textures()->StepCount(material.displacement));
  }
  if (steps <= kMaxTextureSteps) return;
  parameters.Fail(parameters.place(), "its textures are made of " + std::to_string(steps) +
                                          " others; at most " + std::to_string(kMaxTextureSteps) +
                                          " are supported");
}

}  // namespace

void BindTexture(const MaterialInfo& info, uint32_t index, uint32_t node, Material* material) {
  const ParamSpec& spec = info.params[index];
  const uint32_t count = spec.type == ParamType::kRgb ? 3 : 1;
  const uint32_t word = ParamOffset(info, index);
  // A negative default means "unset"; the typical value tells that it is set.
  const float min = spec.fallback[0] < 0.0f ? std::max(spec.min, 0.0f) : spec.min;
  // No two parameters have the same: roughnesses along u and v by textures are two.
  const float typical = 0.5f + 0.0013f * static_cast<float>(index + 1);
  std::fill_n(material->params.begin() + word, count, std::clamp(typical, min, spec.max));
  material->textures.push_back({node, word, count, min, spec.max});
}

bool ReadTexturedParameter(Parameters& parameters, const Parameter& parameter,
                           const MaterialInfo& info, uint32_t index, Material* material) {
  const ParamSpec& spec = info.params[index];
  float* words = material->params.data() + ParamOffset(info, index);
  const bool rgb = spec.type == ParamType::kRgb;
  const uint32_t count = rgb ? 3 : 1;
  if (!rgb && spec.type != ParamType::kFloat) {
    parameters.FailType(parameter, spec.type == ParamType::kBool ? "bool" : "string");
    return false;
  }
  const TextureKind kind = rgb ? TextureKind::kSpectrum : TextureKind::kFloat;
  const uint32_t node = parameters.textures()->Find(parameters, parameter, kind);
  if (parameters.failed()) return false;
  const TextureStep& step = parameters.textures()->node(node);
  if (step.op == TextureOp::kConstant) {
    std::copy(step.value, step.value + count, words);
    return true;
  }
  if (!info.takes_columns()) {
    parameters.Warn(parameter.place, parameter.Title() +
                                         ": textures of this material are not supported; "
                                         "the default is used");
    return false;
  }
  BindTexture(info, index, node, material);
  return false;
}

void ReadRelief(Parameters& parameters, Material* material) {
  ReadHeights(parameters, material);
  if (!parameters.failed()) CheckTextures(parameters, *material);
}

}  // namespace swell
