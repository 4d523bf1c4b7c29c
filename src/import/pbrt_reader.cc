// The directives of pbrt-v4's scene description: a table of names and what each does to the state.
#include "src/import/pbrt_reader.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>

#include "src/import/diagnostics.h"
#include "src/import/lights.h"
#include "src/import/materials.h"
#include "src/import/options.h"
#include "src/import/parameters.h"
#include "src/import/shape_reader.h"
#include "src/import/suggest.h"
#include "src/import/tokens.h"
#include "src/import/transform.h"

namespace swell {
namespace {

constexpr uint32_t kNoMaterial = 0xFFFFFFFFu;         // the default, not yet in the scene
constexpr uint32_t kInterfaceMaterial = 0xFFFFFFFEu;  // the surface is not there

class PbrtReader {
 public:
  explicit PbrtReader(Scene* scene) : scene_(*scene), tokens_(&diagnostics_) {}

  void ReadFile(const std::string& path);
  void Finish();
  Diagnostics& diagnostics() { return diagnostics_; }

 private:
  // What AttributeBegin saves.
  struct State {
    Transform to_world;  // before WorldBegin: world to camera
    bool reverse_orientation = false;
    uint32_t material = kNoMaterial;
    Emission emission;
    bool transform_applies = true;  // false between ActiveTransform EndTime and All
  };
  struct Saved {
    State state;
    Place place;
    std::string_view directive;
  };
  struct NamedMaterial {
    uint32_t index = kNoMaterial;
    Place first_use;
    bool defined = false;
  };
  enum class Block { kOptions, kWorld, kAny };
  struct Directive {
    std::string_view name;
    Block block;
    void (PbrtReader::*read)(Place);
  };
  static const std::vector<Directive>& Directives();

  void ReadDirective(const Token& token);
  void RestoreAfterImports();

  void AttributeBegin(Place place) { Push(place, "AttributeBegin"); }
  void TransformBegin(Place place) { Push(place, "TransformBegin"); }
  void ObjectBegin(Place place);
  void AttributeEnd(Place place) { Pop(place, "AttributeBegin", "AttributeEnd"); }
  void TransformEnd(Place place) { Pop(place, "TransformBegin", "TransformEnd"); }
  void ObjectEnd(Place place);
  void Push(Place place, std::string_view directive);
  void Pop(Place place, std::string_view begin, std::string_view end);

  void WorldBegin(Place place);
  void WorldEnd(Place place);
  void Include(Place place);
  void Import(Place place);

  void Identity(Place) { Set(swell::Transform{}); }
  void Translate(Place place);
  void Scale(Place place);
  void Rotate(Place place);
  void LookAt(Place place);
  void TransformMatrix(Place place);
  void ConcatTransform(Place place);
  void CoordinateSystem(Place place);
  void CoordSysTransform(Place place);
  void ActiveTransform(Place place);
  void TransformTimes(Place place);
  void ReverseOrientation(Place) { state_.reverse_orientation = !state_.reverse_orientation; }

  void Camera(Place place);
  void Film(Place place);
  void Sampler(Place place);
  void PixelFilter(Place place);
  void Integrator(Place place);
  void Accelerator(Place place);
  void ColorSpace(Place place);
  void Option(Place place);

  void Material(Place place);
  void MakeNamedMaterial(Place place);
  void UseNamedMaterial(Place place);
  void LightSource(Place place);
  void AreaLightSource(Place place);
  void Shape(Place place);
  void Texture(Place place);
  void MakeNamedMedium(Place place);
  void MediumInterface(Place place);
  void Attribute(Place place);
  void ObjectInstance(Place place);

  template <size_t N> std::array<double, N> Numbers();
  swell::Transform Matrix(Place place);
  std::string Text(std::string_view what);
  Parameters ParseParameters(Place place, const std::string& owner);
  void SkipParameters(Place place) { ParseParameters(place, ""); }

  void Set(const swell::Transform& t) {
    if (state_.transform_applies) state_.to_world = t;
  }
  void Concat(const swell::Transform& t) { Set(state_.to_world * t); }
  uint32_t AddMaterial(const swell::Material& material);
  uint32_t CurrentMaterial();

  void Fail(Place place, std::string_view what) { diagnostics_.Fail(place, what); }
  void Warn(Place place, std::string_view what) { diagnostics_.Warn(place, what); }
  bool failed() const { return diagnostics_.failed(); }

  Scene& scene_;
  Diagnostics diagnostics_;
  TokenStream tokens_;
  std::string main_folder_;
  bool in_world_ = false;
  Place last_place_;
  float shutter_ = 1.0f;
  State state_;
  std::vector<Saved> saved_;
  struct PendingImport {
    size_t depth;        // of the file stack while its file is read
    size_t saved_count;  // of `saved_`
    State state;
  };
  std::vector<PendingImport> imports_;
  std::map<std::string, swell::Transform> systems_;
  std::map<std::string, NamedMaterial> named_;
  std::map<std::pair<uint32_t, std::array<float, 16>>, uint32_t> unnamed_;
  bool in_object_ = false;
};

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
  last_place_ = {diagnostics_.AddFile(path), 0};
  tokens_.Open(path, {});
  while (!failed()) {
    const Token token = tokens_.Next();
    RestoreAfterImports();
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
    return Fail(token.place,
                "unknown directive " + Quote(token.text) + DidYouMean(token.text, names));
  }
  if (found->block == Block::kWorld && !in_world_) {
    return Fail(token.place, Quote(token.text) + " must come after WorldBegin");
  }
  if (found->block == Block::kOptions && in_world_) {
    return Fail(token.place, Quote(token.text) + " must come before WorldBegin");
  }
  (this->*found->read)(token.place);
}

// ---------------------------------------------------------------- arguments
template <size_t N> std::array<double, N> PbrtReader::Numbers() {
  std::array<double, N> numbers{};
  for (size_t i = 0; i < N && !failed(); ++i) {
    numbers[i] = ParseDouble(tokens_.Next(), &diagnostics_);
  }
  return numbers;
}

// 16 numbers in brackets, column by column as pbrt writes them.
swell::Transform PbrtReader::Matrix(Place place) {
  const bool open = tokens_.Next().kind == TokenKind::kOpen;
  if (!open) Fail(place, "16 numbers in [ ] are expected");
  const std::array<double, 16> columns = Numbers<16>();
  if (!failed() && tokens_.Next().kind != TokenKind::kClose) {
    Fail(place, "16 numbers in [ ] are expected");
  }
  swell::Transform matrix;
  for (size_t row = 0; row < 3; ++row) {
    for (size_t col = 0; col < 4; ++col) {
      matrix.m[4 * row + col] = columns[4 * col + row] / columns[15];
    }
  }
  const bool affine = columns[3] == 0.0 && columns[7] == 0.0 && columns[11] == 0.0;
  if (!failed() && (!affine || columns[15] == 0.0)) {
    Fail(place, "the matrix is not affine; its 4th, 8th and 12th numbers must be 0, its last 1");
  }
  if (!failed() && !Inverse(matrix))
    Fail(place, "the matrix is singular; it flattens what it maps");
  return matrix;
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

Parameters PbrtReader::ParseParameters(Place place, const std::string& owner) {
  const std::string folder = std::filesystem::path(*place.file).parent_path().string();
  Parameters parameters(&diagnostics_, place, owner, {main_folder_, folder});
  parameters.Parse(tokens_);
  return parameters;
}

// ---------------------------------------------------------------- structure
void PbrtReader::Push(Place place, std::string_view directive) {
  if (saved_.size() >= kMaxAttributeDepth) {
    return Fail(place,
                "attributes are nested more than " + std::to_string(kMaxAttributeDepth) + " deep");
  }
  saved_.push_back({state_, place, directive});
}

void PbrtReader::Pop(Place place, std::string_view begin, std::string_view end) {
  if (saved_.empty()) {
    return Fail(place, std::string(end) + " has no " + std::string(begin) + " before it");
  }
  const Saved& saved = saved_.back();
  if (saved.directive != begin) {
    return Fail(place, std::string(end) + " closes the " + std::string(saved.directive) + " of " +
                           ToString(saved.place));
  }
  state_ = saved.state;
  saved_.pop_back();
}

void PbrtReader::ObjectBegin(Place place) {
  Text("the object's name");
  if (in_object_) return Fail(place, "ObjectBegin inside of another object");
  Warn(place, "object instances are not supported; the objects are left out");
  Push(place, "ObjectBegin");
  in_object_ = true;
}

void PbrtReader::ObjectEnd(Place place) {
  Pop(place, "ObjectBegin", "ObjectEnd");
  in_object_ = false;
}

void PbrtReader::ObjectInstance(Place place) {
  const std::string name = Text("the object's name");
  Fail(place, "object instances are not supported; put the shapes of " + Quote(name) +
                  " here instead, with an Include");
}

void PbrtReader::WorldBegin(Place place) {
  for (const Saved& saved : saved_) {
    return Fail(place, "the " + std::string(saved.directive) + " of " + ToString(saved.place) +
                           " is still open");
  }
  in_world_ = true;
  state_ = State{};
  systems_["world"] = swell::Transform{};
}

void PbrtReader::WorldEnd(Place place) {
  Warn(place, "WorldEnd is a directive of older pbrt versions and is ignored");
}

void PbrtReader::Include(Place place) {
  const std::string name = Text("the file's name");
  if (failed()) return;
  const std::string folder = std::filesystem::path(*place.file).parent_path().string();
  Parameters files(&diagnostics_, place, "Include", {main_folder_, folder});
  const std::string path = files.ResolveFile(name, place);
  if (!failed()) tokens_.Open(path, place);
}

// As Include, but what the file does to the state ends with it.
void PbrtReader::Import(Place place) {
  const State state = state_;
  const size_t saved_count = saved_.size();
  Include(place);
  if (!failed()) imports_.push_back({tokens_.depth(), saved_count, state});
}

void PbrtReader::RestoreAfterImports() {
  while (!imports_.empty() && tokens_.depth() < imports_.back().depth) {
    if (saved_.size() != imports_.back().saved_count) {
      return Fail(last_place_, "the imported file opens and closes unequal numbers of attributes");
    }
    state_ = imports_.back().state;
    imports_.pop_back();
  }
}

// ---------------------------------------------------------------- transforms
void PbrtReader::Translate(Place) {
  const auto v = Numbers<3>();
  Concat(swell::Translate(v[0], v[1], v[2]));
}

void PbrtReader::Scale(Place place) {
  const auto v = Numbers<3>();
  if (!failed() && (v[0] == 0.0 || v[1] == 0.0 || v[2] == 0.0)) {
    return Fail(place, "a scale of 0 makes the transform singular");
  }
  Concat(swell::Scale(v[0], v[1], v[2]));
}

void PbrtReader::Rotate(Place place) {
  const auto v = Numbers<4>();
  if (failed()) return;
  if (v[1] == 0.0 && v[2] == 0.0 && v[3] == 0.0) return Fail(place, "the axis of Rotate is zero");
  Concat(swell::Rotate(v[0], {v[1], v[2], v[3]}));
}

void PbrtReader::LookAt(Place place) {
  const auto v = Numbers<9>();
  if (failed()) return;
  const auto look_at = swell::LookAt({v[0], v[1], v[2]}, {v[3], v[4], v[5]}, {v[6], v[7], v[8]});
  if (!look_at) {
    return Fail(place,
                "LookAt: the eye and the target are the same point, or \"up\" is zero or "
                "points along the view");
  }
  Concat(*look_at);
}

void PbrtReader::TransformMatrix(Place place) { Set(Matrix(place)); }
void PbrtReader::ConcatTransform(Place place) { Concat(Matrix(place)); }

void PbrtReader::CoordinateSystem(Place) {
  systems_[Text("the coordinate system's name")] = state_.to_world;
}

void PbrtReader::CoordSysTransform(Place place) {
  const std::string name = Text("the coordinate system's name");
  const auto found = systems_.find(name);
  if (found != systems_.end()) return Set(found->second);
  std::vector<std::string_view> names;
  for (const auto& [known, transform] : systems_) names.push_back(known);
  Fail(place, "unknown coordinate system " + Quote(name) + DidYouMean(name, names));
}

void PbrtReader::ActiveTransform(Place place) {
  const std::string_view which = tokens_.Next().text;
  if (which != "All" && which != "StartTime" && which != "EndTime") {
    return Fail(place, "ActiveTransform is All, StartTime or EndTime, not " + Quote(which));
  }
  if (which == "EndTime") {
    Warn(place, "motion is not supported; the scene stands still at its start time");
  }
  state_.transform_applies = which != "EndTime";
}

void PbrtReader::TransformTimes(Place) { Numbers<2>(); }

// ---------------------------------------------------------------- options
void PbrtReader::Camera(Place place) {
  const std::string type = Text("the camera's type");
  Parameters parameters = ParseParameters(place, "Camera '" + type + "'");
  if (failed()) return;
  ReadCamera(parameters, type, state_.to_world, &scene_.camera, &shutter_);
  if (const auto to_world = Inverse(state_.to_world)) systems_["camera"] = *to_world;
}

void PbrtReader::Film(Place place) {
  const std::string type = Text("the film's type");
  Parameters parameters = ParseParameters(place, "Film '" + type + "'");
  if (!failed()) ReadFilm(parameters, type, &scene_.request);
}

void PbrtReader::Sampler(Place place) {
  const std::string type = Text("the sampler's type");
  Parameters parameters = ParseParameters(place, "Sampler '" + type + "'");
  if (!failed()) ReadSampler(parameters, type, &scene_.request);
}

void PbrtReader::PixelFilter(Place place) {
  const std::string type = Text("the filter's type");
  Parameters parameters = ParseParameters(place, "PixelFilter '" + type + "'");
  if (!failed()) ReadPixelFilter(parameters, type, &scene_.request.filter);
}

void PbrtReader::Integrator(Place place) {
  const std::string type = Text("the integrator's type");
  Parameters parameters = ParseParameters(place, "Integrator '" + type + "'");
  if (!failed()) ReadIntegrator(parameters, type, &scene_.request);
}

void PbrtReader::Accelerator(Place place) {
  Text("the accelerator's type");
  SkipParameters(place);
}

void PbrtReader::ColorSpace(Place place) {
  const std::string name = Text("the colour space's name");
  if (!failed() && name != "srgb") {
    Warn(place, "colour space " + Quote(name) + " is not supported; colours are read as 'srgb'");
  }
}

void PbrtReader::Option(Place place) {
  const std::string name = Text("the option's name");
  const Token value = tokens_.Next();
  if (failed()) return;
  if (value.kind == TokenKind::kEnd)
    return Fail(place, "the value of " + Quote(name) + " is missing");
  if (name == "seed") {
    scene_.request.seed = static_cast<uint32_t>(ParseInteger(value, &diagnostics_));
  } else {
    Warn(place, "option " + Quote(name) + " is ignored");
  }
}

// ---------------------------------------------------------------- materials
// Unnamed materials with the same words are one: runs of rows get longer.
uint32_t PbrtReader::AddMaterial(const swell::Material& material) {
  const auto next = static_cast<uint32_t>(scene_.materials.size());
  if (material.name.empty()) {
    const auto [entry, inserted] = unnamed_.try_emplace({material.kind, material.params}, next);
    if (!inserted) return entry->second;
  }
  scene_.materials.push_back(material);
  return next;
}

uint32_t PbrtReader::CurrentMaterial() {
  return state_.material == kNoMaterial ? AddMaterial(DefaultMaterial("diffuse")) : state_.material;
}

void PbrtReader::Material(Place place) {
  const std::string type = Text("the material's type");
  Parameters parameters = ParseParameters(place, "Material '" + type + "'");
  if (failed()) return;
  if (IsInterfaceMaterial(type)) {
    state_.material = kInterfaceMaterial;
    return;
  }
  const swell::Material material = ReadMaterial(parameters, type);
  if (!failed()) state_.material = AddMaterial(material);
}

void PbrtReader::MakeNamedMaterial(Place place) {
  const std::string name = Text("the material's name");
  Parameters parameters = ParseParameters(place, "material '" + name + "'");
  const std::string type = parameters.String("type", "");
  if (failed()) return;
  NamedMaterial& named = named_[name];
  if (named.defined) return Fail(place, "material " + Quote(name) + " is defined twice");
  named.defined = true;
  if (parameters.Any("type") == nullptr) {
    return Fail(place, "material " + Quote(name) + " has no \"string type\"");
  }
  if (IsInterfaceMaterial(type)) {
    if (named.index != kNoMaterial) {
      return Fail(named.first_use,
                  "material " + Quote(name) + " is an interface; define it before it is used");
    }
    named.index = kInterfaceMaterial;
    return;
  }
  swell::Material material = ReadMaterial(parameters, type);
  material.name = name;
  if (failed()) return;
  if (named.index == kNoMaterial) {
    named.index = AddMaterial(material);
  } else {
    scene_.materials[named.index] = material;
  }
}

// pbrt resolves names at the end of the scene, so a use may come before the definition.
void PbrtReader::UseNamedMaterial(Place place) {
  const std::string name = Text("the material's name");
  if (failed()) return;
  NamedMaterial& named = named_[name];
  if (named.index == kNoMaterial) {
    swell::Material placeholder;
    placeholder.name = name;
    named.index = AddMaterial(placeholder);
    named.first_use = place;
  }
  state_.material = named.index;
}

// ---------------------------------------------------------------- the world
void PbrtReader::LightSource(Place place) {
  const std::string type = Text("the light's type");
  Parameters parameters = ParseParameters(place, "LightSource '" + type + "'");
  if (!failed()) ReadLightSource(parameters, type, state_.to_world, &scene_);
}

void PbrtReader::AreaLightSource(Place place) {
  const std::string type = Text("the area light's type");
  Parameters parameters = ParseParameters(place, "AreaLightSource '" + type + "'");
  if (!failed()) state_.emission = ReadAreaLight(parameters, type);
}

void PbrtReader::Shape(Place place) {
  const std::string type = Text("the shape's type");
  Parameters parameters = ParseParameters(place, "Shape '" + type + "'");
  if (failed() || in_object_) return;
  Placement placement;
  placement.object_to_world = state_.to_world;
  placement.reverse_orientation = state_.reverse_orientation;
  placement.emission = state_.emission;
  placement.place = place;
  placement.name = "Shape '" + type + "'";
  if (!Inverse(state_.to_world)) {
    return Fail(place, placement.name + ": the transform is singular; it flattens the shape");
  }
  if (state_.material == kInterfaceMaterial) {
    Warn(place, "a surface of material 'interface' is left out; media are not supported");
    return;
  }
  placement.material = CurrentMaterial();
  ReadShape(parameters, type, placement, &scene_);
}

void PbrtReader::Texture(Place place) {
  const std::string name = Text("the texture's name");
  Text("the texture's type");
  Text("the texture's class");
  SkipParameters(place);
  if (!failed()) Warn(place, "textures are not supported; " + Quote(name) + " is ignored");
}

void PbrtReader::MakeNamedMedium(Place place) {
  const std::string name = Text("the medium's name");
  SkipParameters(place);
  if (!failed()) Warn(place, "media are not supported; " + Quote(name) + " is ignored");
}

void PbrtReader::MediumInterface(Place place) {
  bool empty = Text("the inner medium's name").empty();
  if (!failed() && tokens_.Peek().kind == TokenKind::kString) {
    empty = tokens_.Next().text.empty() && empty;
  }
  if (!empty) Warn(place, "media are not supported; MediumInterface is ignored");
}

void PbrtReader::Attribute(Place place) {
  const std::string target = Text("what the attribute is for");
  SkipParameters(place);
  if (!failed()) Warn(place, "Attribute " + Quote(target) + " is not supported and is ignored");
}

void PbrtReader::Finish() {
  if (failed()) return;
  for (const Saved& saved : saved_) {
    return Fail(saved.place, std::string(saved.directive) + " is never closed");
  }
  if (!in_world_) return Fail(last_place_, "WorldBegin is missing");
  std::vector<std::string_view> defined;
  for (const auto& [name, material] : named_) {
    if (material.defined) defined.push_back(name);
  }
  for (const auto& [name, material] : named_) {
    if (material.defined) continue;
    return Fail(material.first_use,
                "material " + Quote(name) + " is not defined" + DidYouMean(name, defined));
  }
  scene_.request.image_scale *= shutter_;
  FinishPrimitives(scene_);
  if (scene_.shapes.empty()) Warn({last_place_.file, 0}, "the scene has no shapes");
  const bool emits = std::any_of(scene_.shapes.begin(), scene_.shapes.end(),
                                 [](const swell::Shape& shape) { return shape.emits; });
  if (scene_.lights.empty() && !emits) {
    Warn({last_place_.file, 0}, "the scene has no lights; the picture will be black");
  }
}

}  // namespace

Result<Scene> ReadPbrt(const std::vector<std::string>& paths) {
  Scene scene;
  PbrtReader reader(&scene);
  for (const std::string& path : paths) {
    if (!reader.diagnostics().failed()) reader.ReadFile(path);
  }
  reader.Finish();
  if (reader.diagnostics().failed()) return reader.diagnostics().error();
  scene.warnings = reader.diagnostics().TakeWarnings();
  return scene;
}

}  // namespace swell
