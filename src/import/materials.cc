// Reads materials by the declarations of their kinds (kernels/material.h).
#include "src/import/materials.h"

#include <algorithm>
#include <sstream>

#include "kernels/material.h"
#include "src/base/check.h"
#include "src/import/material_textures.h"
#include "src/import/pbrt_v3.h"
#include "src/import/spectrum.h"
#include "src/base/suggest.h"

namespace swell {
namespace {

// Materials of pbrt-v4; those without a kind of their own are replaced by diffuse.
constexpr std::string_view kPbrtMaterials[] = {
    "coateddiffuse", "coatedconductor", "conductor",      "dielectric", "diffuse",
    "hair",          "measured",        "thindielectric", "subsurface", "diffusetransmission"};

// Parameters that pbrt-v4 documents for some material and that a kind here may lack.
// clang-format off
constexpr std::string_view kPbrtParameters[] = {
    "reflectance", "eta", "k", "roughness", "uroughness", "vroughness", "thickness", "maxdepth",
    "nsamples", "g", "albedo", "sigma_a", "sigma_s", "mfp", "scale", "name", "transmittance",
    "materials", "amount", "filename", "color", "eumelanin", "pheomelanin", "beta_m", "beta_n",
    "alpha", "interface.roughness", "interface.uroughness", "interface.vroughness",
    "interface.eta", "conductor.eta", "conductor.k", "conductor.roughness",
    "conductor.uroughness", "conductor.vroughness"};
// clang-format on

const MaterialInfo* FindKind(std::string_view name, uint32_t* index) {
  for (uint32_t i = 0; i < kMaterialKindCount; ++i) {
    if (kMaterialKinds[i]->name == name) {
      *index = i;
      return kMaterialKinds[i];
    }
  }
  return nullptr;
}

size_t Words(const ParamSpec& spec) { return spec.type == ParamType::kRgb ? 3 : 1; }

const NamedValue* FindNamed(const NamedValue* values, size_t count, std::string_view name) {
  const auto found = std::find_if(values, values + count,
                                  [&](const NamedValue& value) { return name == value.name; });
  return found == values + count ? nullptr : found;
}

// pbrt spells the copper of "eta" as metal-Cu-eta and that of "k" as metal-Cu-k.
std::string_view MetalOf(std::string_view name) {
  if (name.substr(0, 6) == "metal-") name.remove_prefix(6);
  for (std::string_view ending : {"-eta", "-k"}) {
    if (name.size() > ending.size() && name.substr(name.size() - ending.size()) == ending) {
      name.remove_suffix(ending.size());
      break;
    }
  }
  return name;
}

// The value behind a name of the kind's own list. Null, and an error, if there is none.
const NamedValue* ResolveName(Parameters& parameters, const Parameter& parameter,
                              const ParamSpec& spec) {
  if (parameter.strings.size() != 1) {
    parameters.Fail(parameter.place, parameter.Title() + " needs one name in quotes");
    return nullptr;
  }
  const std::string& name = parameter.strings[0];
  for (std::string_view spelling : {std::string_view(name), MetalOf(name)}) {
    const NamedValue* named = FindNamed(spec.named, spec.named_count, spelling);
    if (named == nullptr) continue;
    if (name.rfind("glass-", 0) == 0) {
      parameters.Warn(parameter.place, parameter.Title() + " " + Quote(name) +
                                           " is used with its mean index, without dispersion");
    }
    return named;
  }
  std::vector<std::string_view> names;
  for (uint32_t i = 0; i < spec.named_count; ++i) names.push_back(spec.named[i].name);
  parameters.Fail(parameter.place, parameter.Title() + ": unknown value " + Quote(name) +
                                       DidYouMean(name, names) +
                                       (names.empty() ? "" : " (known: " + ListOf(names) + ")"));
  return nullptr;
}

// Whether a spectrum is given by a name rather than by a file of samples.
bool IsName(const Parameter& parameter) {
  return !parameter.strings.empty() && parameter.strings[0].find('.') == std::string::npos;
}

void CheckRange(Parameters& parameters, const Parameter& parameter, const ParamSpec& spec,
                const float* words) {
  for (size_t i = 0; i < Words(spec); ++i) {
    if (words[i] >= spec.min && words[i] <= spec.max) continue;
    std::ostringstream text;
    text << parameter.Title() << " is " << words[i] << " but must lie between " << spec.min
         << " and " << spec.max;
    return parameters.Fail(parameter.place, text.str());
  }
}

void ReadWords(Parameters& parameters, Parameter& parameter, const ParamSpec& spec, float* words) {
  const bool named = !parameter.strings.empty() && IsName(parameter);
  const bool choice = spec.type == ParamType::kChoice, rgb = spec.type == ParamType::kRgb;
  if (spec.type == ParamType::kBool) {
    if (parameter.type != "bool") return parameters.FailType(parameter, "bool");
    if (parameter.bools.size() != 1) {
      return parameters.Fail(parameter.place, parameter.Title() + " needs one of true and false");
    }
    words[0] = parameter.bools[0] ? 1.0f : 0.0f;
    return;
  }
  if (spec.type == ParamType::kInt) {
    if (parameter.type != "integer") return parameters.FailType(parameter, "integer");
    if (parameter.integers.size() != 1) {
      return parameters.Fail(parameter.place, parameter.Title() + " needs 1 value, not " +
                                                  std::to_string(parameter.integers.size()));
    }
    words[0] = static_cast<float>(parameter.integers[0]);
    return CheckRange(parameters, parameter, spec, words);
  }
  if (parameter.type == "string" || (parameter.type == "spectrum" && named && !choice)) {
    const NamedValue* value = ResolveName(parameters, parameter, spec);
    if (value == nullptr) return;
    std::copy(value->value, value->value + Words(spec), words);
  } else if (choice) {
    return parameters.FailType(parameter, "string");
  } else if (parameter.type == "float") {
    if (parameter.floats.size() != 1) {
      return parameters.Fail(parameter.place, parameter.Title() + " needs 1 value, not " +
                                                  std::to_string(parameter.floats.size()));
    }
    std::fill(words, words + Words(spec), parameter.floats[0]);
  } else if (rgb && (parameter.type == "rgb" || parameter.type == "spectrum")) {
    const Rgb3 color = ReadWeightColor(parameters, parameter);
    std::copy(color.begin(), color.end(), words);
    // Saturated colours of a wider space are brighter than sRGB's in one channel.
    if (parameter.converted) {
      for (size_t c = 0; c < 3; ++c) words[c] = std::min(words[c], spec.max);
    }
  } else if (parameter.type == "spectrum") {
    words[0] = ReadWeightColor(parameters, parameter)[1];
  } else {
    return parameters.FailType(parameter, rgb ? "rgb" : "float");
  }
  if (!parameters.failed()) CheckRange(parameters, parameter, spec, words);
}

// Roughness is the one parameter whose absence matters to many files: it is worth a plain word.
void IgnoreRoughness(Parameters& parameters, const MaterialInfo& info) {
  const auto has = [&](std::string_view name) {
    return std::any_of(info.params, info.params + info.param_count,
                       [&](const ParamSpec& spec) { return name == spec.name; });
  };
  if (!has("remaproughness")) parameters.Accept({"remaproughness"});
  for (std::string_view name : {"roughness", "uroughness", "vroughness"}) {
    if (has(name)) continue;
    const Parameter* parameter = parameters.Any(name);
    if (parameter == nullptr) continue;
    const bool smooth =
        parameter->type == "float" && parameter->floats.size() == 1 && parameter->floats[0] == 0.0f;
    if (smooth) continue;
    parameters.Warn(parameter->place,
                    parameter->Title() + " is not supported; the surface is rendered smooth");
  }
}

void ReadKind(Parameters& parameters, const MaterialInfo& info, Material* material) {
  for (uint32_t i = 0; i < info.param_count && !parameters.failed(); ++i) {
    const ParamSpec& spec = info.params[i];
    Parameter* parameter = parameters.Any(spec.name);
    if (parameter == nullptr) continue;
    if (parameter->type == "texture") {
      const float* words = material->params.data() + ParamOffset(info, i);
      if (ReadTexturedParameter(parameters, *parameter, info, i, material)) {
        CheckRange(parameters, *parameter, spec, words);
      }
    } else {
      ReadWords(parameters, *parameter, spec, material->params.data() + ParamOffset(info, i));
    }
  }
}

// Warns of the parameters that pbrt documents and the kind lacks.
void IgnorePbrtParameters(Parameters& parameters, const MaterialInfo& info) {
  for (std::string_view name : kPbrtParameters) {
    const bool known = std::any_of(info.params, info.params + info.param_count,
                                   [&](const ParamSpec& spec) { return name == spec.name; });
    if (!known && name.find("roughness") != 0 && name != "uroughness" && name != "vroughness") {
      parameters.Ignore({name});
    }
  }
}

Material Replacement(Parameters& parameters, const std::string& type) {
  const bool has_reflectance = parameters.Any("reflectance") != nullptr;
  parameters.Warn(parameters.place(),
                  "type " + Quote(type) + " is not supported; diffuse with " +
                      (has_reflectance ? "its reflectance" : "reflectance 0.5") + " replaces it");
  Material material = DefaultMaterial("diffuse");
  ReadKind(parameters, *kMaterialKinds[material.kind], &material);
  for (std::string_view name : kPbrtParameters) parameters.Accept({name});
  parameters.Accept({"remaproughness", "displacement", "normalmap"});
  parameters.ReportUnknown();
  return material;
}

}  // namespace

bool IsInterfaceMaterial(const std::string& type) {
  return type.empty() || type == "none" || type == "interface";
}

std::array<float, 3> EmittedRadiance(const Material& material) {
  const MaterialInfo& info = *kMaterialKinds[material.kind];
  std::array<float, 3> radiance{};
  float strength = 1.0f;
  for (uint32_t i = 0; i < info.param_count; ++i) {
    const float* words = material.params.data() + ParamOffset(info, i);
    if (std::string_view(info.params[i].name) == "emissive")
      std::copy_n(words, 3, radiance.begin());
    if (std::string_view(info.params[i].name) == "emissive_strength") strength = words[0];
  }
  for (float& channel : radiance) channel *= strength;
  return radiance;
}

Material DefaultMaterial(const std::string& kind) {
  Material material;
  const MaterialInfo* info = FindKind(kind, &material.kind);
  SWELL_CHECK(info != nullptr);
  for (uint32_t i = 0; i < info->param_count; ++i) {
    const ParamSpec& spec = info->params[i];
    const uint32_t offset = ParamOffset(*info, i);
    SWELL_CHECK(offset + Words(spec) <= kMaterialWords);
    std::copy(spec.fallback, spec.fallback + Words(spec), material.params.begin() + offset);
  }
  return material;
}

Material ReadMaterial(Parameters& parameters, const std::string& type) {
  uint32_t kind = 0;
  const MaterialInfo* info = FindKind(type, &kind);
  if (info == nullptr) {
    if (std::find(std::begin(kPbrtMaterials), std::end(kPbrtMaterials), type) !=
        std::end(kPbrtMaterials)) {
      return Replacement(parameters, type);
    }
    std::vector<std::string_view> names;
    for (uint32_t i = 0; i < kMaterialKindCount; ++i) names.push_back(kMaterialKinds[i]->name);
    std::vector<std::string_view> near(names);
    near.push_back("interface");
    near.push_back("mix");
    near.insert(near.end(), std::begin(kPbrtMaterials), std::end(kPbrtMaterials));
    parameters.Fail(parameters.place(), "unknown material " + Quote(type) + DidYouMean(type, near) +
                                            " (known: " + ListOf(names) + ")" + UpgradeHint(type));
    return {};
  }
  Material material = DefaultMaterial(type);
  ReadKind(parameters, *info, &material);
  const auto given = [&](const char* name) { return parameters.Any(name) != nullptr; };
  const bool coated = type == "coatedconductor";
  if ((type == "conductor" || coated) && given("reflectance") &&
      (given(coated ? "conductor.eta" : "eta") || given(coated ? "conductor.k" : "k"))) {
    parameters.Fail(parameters.place(),
                    "a conductor has \"reflectance\" or \"eta\" and \"k\", not both");
  }
  ReadRelief(parameters, &material);
  IgnoreRoughness(parameters, *info);
  IgnorePbrtParameters(parameters, *info);
  parameters.ReportUnknown();
  return material;
}

}  // namespace swell
