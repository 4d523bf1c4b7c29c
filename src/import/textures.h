// Texture directives and the parameters that name them -> texture nodes of the scene.
#ifndef SWELL_IMPORT_TEXTURES_H_
#define SWELL_IMPORT_TEXTURES_H_

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "src/import/parameters.h"
#include "src/import/read_image.h"
#include "src/import/row_map.h"
#include "src/import/scene_parts.h"
#include "src/import/shared_reads.h"
#include "src/import/transform.h"
#include "src/scene/scene.h"

namespace swell {

enum class TextureKind { kFloat, kSpectrum };

// Nodes by name; one set of names for each kind, as in pbrt.
using NodeNames = std::map<std::pair<TextureKind, std::string>, uint32_t, std::less<>>;

// What an imported file may name: the textures that were defined before it.
struct DefinedTextures {
  std::vector<TextureStep> nodes;
  NodeNames names;
};

// The textures defined so far. A texture can only name earlier ones, so none can depend on itself.
class TextureNames {
 public:
  // `parts` tells what is wrong with images. Nodes of `outer` come before those of the scene.
  TextureNames(Scene* scene, SceneParts* parts, SharedReads* reads,
               std::shared_ptr<const DefinedTextures> outer)
      : scene_(*scene), parts_(*parts), reads_(*reads), outer_(std::move(outer)) {}

  std::shared_ptr<const DefinedTextures> Defined();

  // Reads a directive: Texture "name" "kind" "type" parameters.
  void Define(Parameters& parameters, const std::string& name, const std::string& kind,
              const std::string& type, const Transform& to_world);

  // The node that a parameter of type "texture" names; fails if there is none.
  uint32_t Find(Parameters& parameters, const Parameter& parameter, TextureKind kind);
  // The node of a number, a colour or a texture; of `fallback` if the parameter is absent.
  uint32_t Input(Parameters& parameters, std::string_view name, TextureKind kind, float fallback);
  uint32_t Constant(const std::array<float, 3>& value);
  // The row that the scene's image will have; each file is read once for each use.
  uint32_t Image(Parameters& parameters, const Parameter& file, TextureKind kind,
                 const Encoding& encoding);

  // The node of a row of the scene's images that holds normals.
  uint32_t NormalMap(uint32_t image);

  const TextureStep& node(uint32_t row) const {
    return row < outer_count() ? outer_->nodes[row] : scene_.texture_nodes[row - outer_count()];
  }
  size_t StepCount(uint32_t node) const;

  // Adds the nodes and images of an imported file, whose textures had those here for `outer`.
  void Absorb(const TextureNames& inner, RowMap* map);
  // When they are read, and nothing is wrong with them.
  void MoveImagesToScene();

 private:
  using Reader = void (TextureNames::*)(Parameters&, TextureKind, const Transform&, TextureStep*);
  struct Type {
    std::string_view name;
    TextureOp op;
    Reader read;
  };
  static const Type* FindType(std::string_view name);
  static std::vector<std::string_view> TypeNames();

  void ReadConstant(Parameters&, TextureKind, const Transform&, TextureStep*);
  void ReadScale(Parameters&, TextureKind, const Transform&, TextureStep*);
  void ReadMix(Parameters&, TextureKind, const Transform&, TextureStep*);
  void ReadDirectionMix(Parameters&, TextureKind, const Transform&, TextureStep*);
  void ReadBilerp(Parameters&, TextureKind, const Transform&, TextureStep*);
  void ReadImagemap(Parameters&, TextureKind, const Transform&, TextureStep*);
  void ReadCheckerboard(Parameters&, TextureKind, const Transform&, TextureStep*);
  void ReadDots(Parameters&, TextureKind, const Transform&, TextureStep*);
  void ReadNoise(Parameters&, TextureKind, const Transform&, TextureStep*);
  void ReadMapping(Parameters& parameters, const Transform& to_world, TextureStep* step);
  std::array<float, 3> Value(Parameters& parameters, Parameter& parameter, TextureKind kind);

  size_t outer_count() const { return outer_ == nullptr ? 0 : outer_->nodes.size(); }
  uint32_t AddNode(const TextureStep& step);
  // The node of that name; kNoTexture: there is none.
  uint32_t Named(TextureKind kind, const std::string& name) const;
  uint32_t ImageRow(const std::shared_ptr<SharedImage>& image);

  Scene& scene_;
  SceneParts& parts_;
  SharedReads& reads_;
  std::shared_ptr<const DefinedTextures> outer_;    // null: none
  std::shared_ptr<const DefinedTextures> defined_;  // the last answer, if it is still right
  NodeNames names_;
  std::vector<std::shared_ptr<SharedImage>> images_;  // by row
  std::map<const SharedImage*, uint32_t> image_rows_;
};

}  // namespace swell

#endif  // SWELL_IMPORT_TEXTURES_H_
