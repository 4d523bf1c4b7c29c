// The names of textures and their inputs.
#include "src/import/textures.h"

#include <algorithm>

#include "src/base/suggest.h"
#include "src/import/pbrt_v3.h"
#include "src/import/spectrum.h"

namespace swell {

void TextureNames::Define(Parameters& parameters, const std::string& name, const std::string& kind,
                          const std::string& type, const Transform& to_world) {
  if (kind != "float" && kind != "spectrum") {
    const std::string hint = kind == "color" || kind == "rgb"
                                 ? "; did you mean 'spectrum'?" + UpgradeHint(kind)
                                 : DidYouMean(kind, {"float", "spectrum"});
    return parameters.Fail(parameters.place(),
                           "a texture is of \"float\" or \"spectrum\", not " + Quote(kind) + hint);
  }
  const TextureKind which = kind == "float" ? TextureKind::kFloat : TextureKind::kSpectrum;
  if (nodes_.count({which, name}) != 0) {
    return parameters.Fail(parameters.place(), "the " + kind + " texture " + Quote(name) +
                                                   " is defined twice; rename one of the two");
  }
  TextureStep step;
  if (type == "ptex") {
    parameters.Warn(parameters.place(), "'ptex' is not supported; 0.5 everywhere replaces it");
    std::fill(step.value, step.value + 3, 0.5f);
    parameters.Accept({"filename", "encoding", "scale"});
  } else if (const Type* found = FindType(type)) {
    step.op = found->op;
    (this->*found->read)(parameters, which, to_world, &step);
  } else {
    return parameters.Fail(parameters.place(), "unknown texture type " + Quote(type) +
                                                   DidYouMean(type, TypeNames()) +
                                                   " (known: " + ListOf(TypeNames()) + ")");
  }
  parameters.ReportUnknown();
  if (parameters.failed()) return;
  scene_.texture_nodes.push_back(step);
  nodes_[{which, name}] = static_cast<uint32_t>(scene_.texture_nodes.size() - 1);
}

uint32_t TextureNames::Find(Parameters& parameters, const Parameter& parameter, TextureKind kind) {
  if (parameter.strings.size() != 1) {
    parameters.Fail(parameter.place, parameter.Title() + " needs the name of one texture");
    return 0;
  }
  const std::string& name = parameter.strings[0];
  const auto found = nodes_.find({kind, name});
  if (found != nodes_.end()) return found->second;
  const char* word = kind == TextureKind::kFloat ? "float" : "spectrum";
  const char* other_word = kind == TextureKind::kFloat ? "spectrum" : "float";
  const TextureKind other =
      kind == TextureKind::kFloat ? TextureKind::kSpectrum : TextureKind::kFloat;
  std::string what =
      parameter.Title() + ": there is no " + word + " texture " + Quote(name) + " before this line";
  if (nodes_.count({other, name}) != 0) {
    what += std::string("; the one of that name is of \"") + other_word + "\", make it \"" + word +
            "\"";
  } else {
    std::vector<std::string_view> names;
    for (const auto& [key, node] : nodes_) {
      if (key.first == kind) names.push_back(key.second);
    }
    what += DidYouMean(name, names);
  }
  parameters.Fail(parameter.place, what);
  return 0;
}

uint32_t TextureNames::Constant(const std::array<float, 3>& value) {
  TextureStep step;
  std::copy(value.begin(), value.end(), step.value);
  scene_.texture_nodes.push_back(step);
  return static_cast<uint32_t>(scene_.texture_nodes.size() - 1);
}

std::array<float, 3> TextureNames::Value(Parameters& parameters, Parameter& parameter,
                                         TextureKind kind) {
  if (parameter.type == "float") {
    if (parameter.floats.size() == 1) {
      return {parameter.floats[0], parameter.floats[0], parameter.floats[0]};
    }
    parameters.Fail(parameter.place, parameter.Title() + " needs 1 value, not " +
                                         std::to_string(parameter.floats.size()));
    return {};
  }
  if (kind == TextureKind::kSpectrum && (parameter.type == "rgb" || parameter.type == "spectrum")) {
    return ReadWeightColor(parameters, parameter);
  }
  parameters.FailType(parameter, kind == TextureKind::kSpectrum ? "rgb" : "float");
  return {};
}

uint32_t TextureNames::Input(Parameters& parameters, std::string_view name, TextureKind kind,
                             float fallback) {
  Parameter* parameter = parameters.Any(name);
  if (parameter == nullptr) return Constant({fallback, fallback, fallback});
  if (parameter->type == "texture") return Find(parameters, *parameter, kind);
  return Constant(Value(parameters, *parameter, kind));
}

uint32_t TextureNames::NormalMap(uint32_t image) {
  scene_.texture_nodes.push_back(NormalMapStep(image));
  return static_cast<uint32_t>(scene_.texture_nodes.size() - 1);
}

uint32_t TextureNames::Image(Parameters& parameters, const Parameter& file, TextureKind kind,
                             const Encoding& encoding) {
  if (file.type != "string" || file.strings.size() != 1) {
    parameters.FailType(file, "string");
    return 0;
  }
  const std::string path = parameters.ResolveFile(file.strings[0], file.place);
  if (parameters.failed()) return 0;
  const auto key = std::make_tuple(path, kind, static_cast<int>(encoding.curve), encoding.gamma);
  if (const auto known = images_.find(key); known != images_.end()) return known->second;
  const ImageUse use = kind == TextureKind::kFloat ? ImageUse::kScalar : ImageUse::kColor;
  const auto row = static_cast<uint32_t>(scene_.images.size());
  scene_.images.emplace_back();
  images_.emplace(key, row);
  const Place place = file.place;
  const std::string prefix = parameters.Prefix();
  parts_.DeferImage(place, row, [=](Scene& part, Diagnostics& diagnostics) {
    const Result<ReadPixels> read = ReadImagePixels(path, use, encoding);
    if (!read) return diagnostics.Fail(place, prefix + read.error().message);
    if (read->not_finite > 0) {
      diagnostics.Warn(place, prefix + path + ": " + std::to_string(read->not_finite) +
                                  " values are not finite; they count as 0");
    }
    part.images.push_back(MakeTexelImage(read->pixels, Levels::kAll));
    part.images.back().name = path;
  });
  return row;
}

}  // namespace swell
