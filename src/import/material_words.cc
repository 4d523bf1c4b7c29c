// Finds parameters in the registry of materials.
#include "src/import/material_words.h"

#include <algorithm>

#include "kernels/material.h"
#include "src/base/check.h"
#include "src/import/material_textures.h"

namespace swell {
namespace {

uint32_t FindParameter(std::string_view name, const Material& material) {
  const MaterialInfo& info = *kMaterialKinds[material.kind];
  uint32_t i = 0;
  while (i < info.param_count && info.params[i].name != name) ++i;
  SWELL_CHECK(i < info.param_count);
  return i;
}

// A value that is no number becomes the least.
float Within(double value, const ParamSpec& spec) {
  return static_cast<float>(
      std::clamp<double>(value >= spec.min ? value : spec.min, spec.min, spec.max));
}

}  // namespace

void SetNumber(std::string_view parameter, double value, Material* material) {
  SetColor(parameter, {value, value, value}, material);
}

void SetColor(std::string_view parameter, const std::array<double, 3>& value, Material* material) {
  const MaterialInfo& info = *kMaterialKinds[material->kind];
  const uint32_t index = FindParameter(parameter, *material);
  const ParamSpec& spec = info.params[index];
  float* words = material->params.data() + ParamOffset(info, index);
  const size_t count = spec.type == ParamType::kRgb ? 3 : 1;
  for (size_t c = 0; c < count; ++c) words[c] = Within(value[c], spec);
}

void SetTexture(std::string_view parameter, uint32_t node, Material* material) {
  const uint32_t index = FindParameter(parameter, *material);
  BindTexture(*kMaterialKinds[material->kind], index, node, material);
}

}  // namespace swell
