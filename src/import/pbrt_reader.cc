// The directives of pbrt-v4's scene description: a table of names, and what calls them in a file's
// order.
#include "src/import/pbrt_reader.h"

#include <algorithm>
#include <filesystem>

#include "src/base/suggest.h"
#include "src/import/pbrt_directives.h"
#include "src/import/materials.h"
#include "src/import/pbrt_v3.h"

namespace swell {

const std::vector<PbrtReader::Directive>& PbrtReader::Directives() {
  using R = PbrtReader;
  static const std::vector<Directive> kDirectives = {
      {"Accelerator", Block::kOptions, &R::Accelerator},
      {"ActiveTransform", Block::kAny, &R::ActiveTransform},
      {"AreaLightSource", Block::kWorld, &R::AreaLightSource},
      {"Attribute", Block::kAny, &R::Attribute},
      {"AttributeBegin", Block::kWorld, &R::AttributeBegin},
      {"AttributeEnd", Block::kWorld, &R::AttributeEnd},
      {"Camera", Block::kOptions, &R::Camera},
      {"ColorSpace", Block::kAny, &R::ColorSpace},
      {"ConcatTransform", Block::kAny, &R::ConcatTransform},
      {"CoordSysTransform", Block::kAny, &R::CoordSysTransform},
      {"CoordinateSystem", Block::kAny, &R::CoordinateSystem},
      {"Film", Block::kOptions, &R::Film},
      {"Identity", Block::kAny, &R::Identity},
      {"Import", Block::kWorld, &R::Import},
      {"Include", Block::kAny, &R::Include},
      {"Integrator", Block::kOptions, &R::Integrator},
      {"LightSource", Block::kWorld, &R::LightSource},
      {"LookAt", Block::kAny, &R::LookAt},
      {"MakeNamedMaterial", Block::kWorld, &R::MakeNamedMaterial},
      {"MakeNamedMedium", Block::kAny, &R::MakeNamedMedium},
      {"Material", Block::kWorld, &R::Material},
      {"MediumInterface", Block::kAny, &R::MediumInterface},
      {"NamedMaterial", Block::kWorld, &R::UseNamedMaterial},
      {"ObjectBegin", Block::kWorld, &R::ObjectBegin},
      {"ObjectEnd", Block::kWorld, &R::ObjectEnd},
      {"ObjectInstance", Block::kWorld, &R::ObjectInstance},
      {"Option", Block::kAny, &R::Option},
      {"PixelFilter", Block::kOptions, &R::PixelFilter},
      {"ReverseOrientation", Block::kWorld, &R::ReverseOrientation},
      {"Rotate", Block::kAny, &R::Rotate},
      {"Sampler", Block::kOptions, &R::Sampler},
      {"Scale", Block::kAny, &R::Scale},
      {"Shape", Block::kWorld, &R::Shape},
      {"Texture", Block::kWorld, &R::Texture},
      {"Transform", Block::kAny, &R::TransformMatrix},
      {"TransformBegin", Block::kAny, &R::TransformBegin},
      {"TransformEnd", Block::kAny, &R::TransformEnd},
      {"TransformTimes", Block::kAny, &R::TransformTimes},
      {"Translate", Block::kAny, &R::Translate},
      {"WorldBegin", Block::kOptions, &R::WorldBegin},
      {"WorldEnd", Block::kWorld, &R::WorldEnd},
  };
  return kDirectives;
}

void PbrtReader::ReadFile(const std::string& path) {
  main_folder_ = std::filesystem::path(path).parent_path().string();
  main_file_ = last_place_ = {diagnostics_.AddFile(path), 0};
  tokens_.Open(path, {});
  ReadDirectives();
}

void PbrtReader::ReadDirectives() {
  while (!failed()) {
    const Token token = tokens_.Next();
    if (token.kind == TokenKind::kEnd) break;
    last_place_ = token.place;
    ReadDirective(token);
  }
}

void PbrtReader::ReadDirective(const Token& token) {
  if (token.kind != TokenKind::kWord) {
    const char* what = token.kind == TokenKind::kString ? "text " : "";
    return Fail(token.place, "a directive is expected, not " + (what + Quote(token.text)));
  }
  const std::vector<Directive>& directives = Directives();
  const auto found = std::find_if(directives.begin(), directives.end(),
                                  [&](const Directive& d) { return d.name == token.text; });
  if (found == directives.end()) {
    std::vector<std::string_view> names;
    for (const Directive& directive : directives) names.push_back(directive.name);
    return Fail(token.place, "unknown directive " + Quote(token.text) +
                                 DidYouMean(token.text, names) + UpgradeHint(token.text));
  }
  if (found->block == Block::kWorld && !in_world_) {
    return Fail(token.place, Quote(token.text) + " must come after WorldBegin");
  }
  if (found->block == Block::kOptions && in_world_) {
    return Fail(token.place, Quote(token.text) + " must come before WorldBegin");
  }
  (this->*found->read)(token.place);
}

std::string PbrtReader::Text(std::string_view what) {
  const Token token = tokens_.Next();
  if (token.kind != TokenKind::kString) {
    Fail(token.kind == TokenKind::kEnd ? last_place_ : token.place,
         std::string(what) + " in quotes is expected" +
             (token.kind == TokenKind::kEnd ? "" : ", not " + Quote(token.text)));
  }
  return std::string(token.text);
}

Parameters PbrtReader::ParseParameters(Place place, const std::string& owner, Target target) {
  const std::string folder = std::filesystem::path(*place.file).parent_path().string();
  Parameters parameters(&diagnostics_, place, owner, {main_folder_, folder});
  parameters.SetTextures(&textures_);
  parameters.Parse(tokens_);
  if (target == Target::kNothing || failed()) return parameters;
  ConvertColors(parameters, target);
  if (state_.defaults != nullptr) {
    parameters.AddDefaults((*state_.defaults)[static_cast<size_t>(target)]);
  }
  return parameters;
}

void PbrtReader::Finish() {
  tokens_.Close();
  reads_.Wait();
  if (!imports_.empty() && *reads_.opened() > kMaxIncludedFiles) {
    // Which of them was one too many depends on the threads.
    Diagnostics diagnostics;
    diagnostics.Fail(main_file_, TooManyFiles());
    return diagnostics_.Take(diagnostics);
  }
  if (AllRead()) AbsorbImports();
  if (AllRead()) ShareMeshes();
  parts_.MakeAll();
  parts_.Tell(&diagnostics_);
  if (failed()) return;
  parts_.Join(&scene_, &diagnostics_);
  if (failed()) return;
  textures_.MoveImagesToScene();
  for (const Saved& saved : saved_) {
    return Fail(saved.place, std::string(saved.directive) + " is never closed");
  }
  if (!in_world_) return Fail(last_place_, "WorldBegin is missing");
  std::vector<std::string_view> defined;
  for (const auto& [name, material] : named_) {
    if (material.defined()) defined.push_back(name);
  }
  for (const auto& [name, material] : named_) {
    if (material.defined()) continue;
    return Fail(material.first_use,
                "material " + Quote(name) + " is not defined" + DidYouMean(name, defined));
  }
  FinishObjects();
  if (failed()) return;
  FinishGlow();
  JoinObjects();
  FinishMedia();
  if (failed()) return;
  scene_.request.image_scale *= shutter_;
  FinishPrimitives(scene_);
  if (scene_.shapes.empty()) Warn({last_place_.file, 0}, "the scene has no shapes");
  const bool emits = std::any_of(scene_.shapes.begin(), scene_.shapes.end(),
                                 [](const swell::Shape& shape) { return shape.emits; });
  if (scene_.lights.empty() && !emits) {
    Warn({last_place_.file, 0}, "the scene has no lights; the picture will be black");
  }
}

namespace {

// Tasks use the reader, also when reading ends for want of memory.
struct WaitAtEnd {
  SharedReads* reads;
  ~WaitAtEnd() { reads->Wait(); }
};

}  // namespace

Result<Scene> ReadPbrt(const std::vector<std::string>& paths) {
  Scene scene;
  SharedReads reads;
  PbrtReader reader(&scene, &reads);
  const WaitAtEnd wait{&reads};
  for (const std::string& path : paths) {
    if (!reader.diagnostics().failed()) reader.ReadFile(path);
  }
  reader.Finish();
  if (reader.diagnostics().failed()) return reader.diagnostics().error();
  scene.warnings = reader.diagnostics().TakeWarnings();
  return scene;
}

}  // namespace swell
