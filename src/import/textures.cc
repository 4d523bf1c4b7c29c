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
  if (Named(which, name) != kNoTexture) {
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
    return parameters.Fail(parameters.place(),
                           "unknown texture type " + Quote(type) + KnownWords(type, TypeNames()));
  }
  parameters.ReportUnknown();
  if (parameters.failed()) return;
  names_[{which, name}] = AddNode(step);
}

uint32_t TextureNames::AddNode(const TextureStep& step) {
  defined_.reset();
  scene_.texture_nodes.push_back(step);
  return static_cast<uint32_t>(outer_count() + scene_.texture_nodes.size() - 1);
}

uint32_t TextureNames::Named(TextureKind kind, const std::string& name) const {
  const auto own = names_.find({kind, name});
  if (own != names_.end()) return own->second;
  if (outer_ == nullptr) return kNoTexture;
  const auto outer = outer_->names.find({kind, name});
  return outer == outer_->names.end() ? kNoTexture : outer->second;
}

size_t TextureNames::StepCount(uint32_t top) const {
  return NodesBelow([&](uint32_t row) -> const TextureStep& { return node(row); }, top).size();
}

std::shared_ptr<const DefinedTextures> TextureNames::Defined() {
  if (defined_ != nullptr) return defined_;
  auto defined = outer_ == nullptr ? std::make_shared<DefinedTextures>()
                                   : std::make_shared<DefinedTextures>(*outer_);
  defined->nodes.insert(defined->nodes.end(), scene_.texture_nodes.begin(),
                        scene_.texture_nodes.end());
  defined->names.insert(names_.begin(), names_.end());
  defined_ = std::move(defined);
  return defined_;
}

uint32_t TextureNames::Find(Parameters& parameters, const Parameter& parameter, TextureKind kind) {
  if (parameter.strings.size() != 1) {
    parameters.Fail(parameter.place, parameter.Title() + " needs the name of one texture");
    return 0;
  }
  const std::string& name = parameter.strings[0];
  if (const uint32_t found = Named(kind, name); found != kNoTexture) return found;
  const char* word = kind == TextureKind::kFloat ? "float" : "spectrum";
  const char* other_word = kind == TextureKind::kFloat ? "spectrum" : "float";
  const TextureKind other =
      kind == TextureKind::kFloat ? TextureKind::kSpectrum : TextureKind::kFloat;
  std::string what =
      parameter.Title() + ": there is no " + word + " texture " + Quote(name) + " before this line";
  if (Named(other, name) != kNoTexture) {
    what += std::string("; the one of that name is of \"") + other_word + "\", make it \"" + word +
            "\"";
  } else {
    std::vector<std::string_view> names;
    const auto add_names = [&](const NodeNames& nodes) {
      for (const auto& [key, row] : nodes) {
        if (key.first == kind) names.push_back(key.second);
      }
    };
    add_names(names_);
    if (outer_ != nullptr) add_names(outer_->names);
    what += DidYouMean(name, names);
  }
  parameters.Fail(parameter.place, what);
  return 0;
}

uint32_t TextureNames::Constant(const std::array<float, 3>& value) {
  TextureStep step;
  std::copy(value.begin(), value.end(), step.value);
  return AddNode(step);
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

uint32_t TextureNames::NormalMap(uint32_t image) { return AddNode(NormalMapStep(image)); }

uint32_t TextureNames::Image(Parameters& parameters, const Parameter& file, TextureKind kind,
                             const Encoding& encoding) {
  if (file.type != "string" || file.strings.size() != 1) {
    parameters.FailType(file, "string");
    return 0;
  }
  const std::string path = parameters.ResolveFile(file.strings[0], file.place);
  if (parameters.failed()) return 0;
  const ImageUse use = kind == TextureKind::kFloat ? ImageUse::kScalar : ImageUse::kColor;
  const std::shared_ptr<SharedImage> image = reads_.Image(path, use, encoding);
  const size_t known = images_.size();
  const uint32_t row = ImageRow(image);
  if (row == known) parts_.AddImage(file.place, parameters.Prefix(), image);
  return row;
}

uint32_t TextureNames::ImageRow(const std::shared_ptr<SharedImage>& image) {
  const auto [at, is_new] =
      image_rows_.try_emplace(image.get(), static_cast<uint32_t>(images_.size()));
  if (is_new) images_.push_back(image);
  return at->second;
}

void TextureNames::Absorb(const TextureNames& inner, RowMap* map) {
  for (const std::shared_ptr<SharedImage>& image : inner.images_) {
    map->images.push_back(ImageRow(image));
  }
  map->outer_nodes = static_cast<uint32_t>(inner.outer_count());
  map->first_node = static_cast<uint32_t>(outer_count() + scene_.texture_nodes.size());
  for (TextureStep step : inner.scene_.texture_nodes) {
    for (uint32_t& input : step.input) input = map->Node(input);
    if (step.op == TextureOp::kImage) step.image = map->Image(step.image);
    AddNode(step);
  }
}

void TextureNames::MoveImagesToScene() {
  for (const std::shared_ptr<SharedImage>& image : images_) {
    scene_.images.push_back(std::move(**image->image));
  }
}

}  // namespace swell
