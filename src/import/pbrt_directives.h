// Reads pbrt-v4 scene descriptions into a scene: a method for each directive, and the state that
// they change. The methods' files are pbrt_*.cc.
#ifndef SWELL_IMPORT_PBRT_DIRECTIVES_H_
#define SWELL_IMPORT_PBRT_DIRECTIVES_H_

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "src/import/color_space.h"
#include "src/import/diagnostics.h"
#include "src/import/parameters.h"
#include "src/import/scene_parts.h"
#include "src/import/shapes.h"
#include "src/import/shared_reads.h"
#include "src/import/textures.h"
#include "src/import/tokens.h"
#include "src/import/transform.h"
#include "src/scene/scene.h"

namespace swell {

inline constexpr uint32_t kNoMaterial = 0xFFFFFFFFu;         // the default, not yet in the scene
inline constexpr uint32_t kInterfaceMaterial = 0xFFFFFFFEu;  // the surface is not there

class PbrtReader {
 public:
  // Of whole scenes.
  PbrtReader(Scene* scene, SharedReads* reads);
  // Of a file that `outer` imports: begins with a copy of its state. The scene receives what the
  // file adds, with rows of its own, until `outer` absorbs it.
  PbrtReader(Scene* scene, PbrtReader& outer, Place place);

  PbrtReader(const PbrtReader&) = delete;
  ~PbrtReader();

  void ReadFile(const std::string& path);
  void Finish();
  Diagnostics& diagnostics() { return diagnostics_; }

 private:
  // What Attribute gives defaults to.
  enum class Target : uint32_t { kShape, kLight, kMaterial, kMedium, kTexture, kNothing };
  using Defaults = std::array<std::vector<Parameter>, static_cast<size_t>(Target::kNothing)>;

  // What AttributeBegin saves.
  struct State {
    Transform to_world;  // before WorldBegin: world to camera
    bool reverse_orientation = false;
    uint32_t material = kNoMaterial;
    Emission emission;
    bool transform_applies = true;                 // false between ActiveTransform EndTime and All
    uint32_t inside = kVacuum, outside = kVacuum;  // rows of the scene's media
    ColorSpaceName color_space = ColorSpaceName::kSrgb;
    std::shared_ptr<const Defaults> defaults;  // null: none
  };
  struct Saved {
    State state;
    Place place;
    std::string_view directive;
  };
  struct NamedMaterial {
    uint32_t index = kNoMaterial;
    Place first_use;
    Place definition;  // without a file: none yet
    bool defined() const { return definition.file != nullptr; }
  };
  struct NamedMedium {
    uint32_t row = kVacuum;
    Place first_use;
    Place definition;  // likewise
    bool defined() const { return definition.file != nullptr; }
  };
  enum class Block { kOptions, kWorld, kAny };
  struct Directive {
    std::string_view name;
    Block block;
    void (PbrtReader::*read)(Place);
  };
  static const std::vector<Directive>& Directives();

  void ReadDirectives();
  void ReadDirective(const Token& token);
  std::string FileNamedBy(Place place, const std::string& directive);

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
  uint32_t NamedIndex(const std::string& name, Place place);
  uint32_t AddMix(Parameters& parameters, const std::string& name);
  NamedMaterial* BeginMaterial(const std::string& name, Place place);
  void DefineMaterial(NamedMaterial* named, const swell::Material& material);
  // As a mix or an interface.
  void DefineOther(NamedMaterial* named, const std::string& name, uint32_t index);
  void LightSource(Place place);
  void AreaLightSource(Place place);
  void Shape(Place place);
  void Texture(Place place);
  void MakeNamedMedium(Place place);
  void MediumInterface(Place place);
  NamedMedium& MediumOf(const std::string& name, Place place);
  void DefineMedium(const std::string& name, Place place, const std::array<float, 3>& absorption);
  void PlaceMedia(Placement* placement);
  void FinishMedia();
  void Attribute(Place place);
  void ObjectInstance(Place place);

  template <size_t N> std::array<double, N> Numbers();
  swell::Transform Matrix(Place place);
  std::string Text(std::string_view what);
  Parameters ParseParameters(Place place, const std::string& owner,
                             Target target = Target::kNothing);
  void ConvertColors(Parameters& parameters, Target target) const;
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

  // Imported files are read by tasks, then absorbed in their order.
  struct ImportedFile;
  void ReadImported(const std::string& path, Place place);
  bool AllRead() const;
  void AbsorbImports();
  void Absorb(ImportedFile* file);
  void AbsorbLights(PbrtReader* inner, RowMap* map);
  void AbsorbMedia(const PbrtReader& inner, RowMap* map);
  void AbsorbMaterials(const PbrtReader& inner, RowMap* map);
  void AbsorbMixes(const PbrtReader& inner, RowMap* map);
  void AbsorbObjects(const PbrtReader& inner);

  Scene& scene_;
  SharedReads& reads_;
  Diagnostics diagnostics_;
  TokenStream tokens_;
  SceneParts parts_;  // all geometry, until it is joined
  TextureNames textures_;
  std::string main_folder_;
  bool in_world_ = false;
  Place main_file_;  // the last, if there are several
  Place last_place_;
  float shutter_ = 1.0f;
  State state_;
  std::vector<Saved> saved_;
  std::vector<std::unique_ptr<ImportedFile>> imports_;
  bool is_import_ = false;
  // Of imported files: what their state had at first of the importing file's tables.
  uint32_t outer_material_ = kNoMaterial;    // what row 0 stands for; kNoMaterial: itself
  uint32_t outer_image_light_ = kNoTexture;  // likewise
  std::map<std::string, swell::Transform> systems_;
  std::map<std::string, NamedMaterial> named_;
  std::map<std::string, NamedMedium> media_;
  uint32_t border_alpha_ = kNoTexture;  // the texture that is 0
  std::map<std::pair<uint32_t, MaterialParams>, uint32_t> unnamed_;

  // Objects: definitions by number, so that a use may come before its object.
  struct ObjectUse {
    uint32_t definition;
    swell::Transform to_parent;  // to the world, or to the object that contains the use
    Place place;
  };
  struct ObjectDefinition {
    std::string name;
    Place place;  // of ObjectBegin; before that, of the first use
    bool defined = false;
    bool imports = false;     // files within it, which are not read until the end
    bool complete = false;    // so is everything it contains
    bool on_path = false;     // while what it contains is completed
    uint32_t depth = 0;       // of objects within objects
    uint32_t object = kNone;  // row of the scene's objects, if it has shapes of its own
    uint64_t instances = 0;   // that one use of it makes
    std::vector<ObjectUse> uses;
  };
  uint32_t DefinitionOf(const std::string& name, Place place);
  bool in_object() const { return open_object_ != kNone; }
  bool CompleteObject(uint32_t definition, uint32_t level, bool last);
  bool FailNesting(const ObjectDefinition& definition);
  void FailInstances(Place place);
  void PlaceUse(const ObjectUse& use);
  void AddInstances(uint32_t definition, const swell::Transform& to_world, Place place);
  void FinishObjects();
  void ShareMeshes();
  void FinishGlow();
  void JoinObjects();
  void ArrangeObjects();

  std::map<std::string, uint32_t> object_names_;
  std::vector<ObjectDefinition> objects_;
  std::vector<ObjectUse> waiting_uses_;  // of the world, of objects that were not complete
  uint32_t open_object_ = kNone;
  size_t open_part_ = 0;  // where the open object's shapes begin
  struct ObjectParts {
    const SceneParts* parts;
    size_t first, end;
  };
  std::vector<ObjectParts> object_parts_;  // of the scene's objects
};

}  // namespace swell

#endif  // SWELL_IMPORT_PBRT_DIRECTIVES_H_
