// Texture directives and the parameters that name them -> texture nodes of the scene.
#ifndef SWELL_IMPORT_TEXTURES_H_
#define SWELL_IMPORT_TEXTURES_H_

#include <map>
#include <string>
#include <tuple>

#include "src/import/parameters.h"
#include "src/import/read_image.h"
#include "src/import/scene_parts.h"
#include "src/import/transform.h"
#include "src/scene/scene.h"

namespace swell {

enum class TextureKind { kFloat, kSpectrum };

// The textures defined so far, by name; one set of names for each kind, as in pbrt. A texture can
// only name earlier ones, so none can depend on itself.
class TextureNames {
 public:
  // Images are read by the threads of `parts`, which join them to the scene.
  TextureNames(Scene* scene, SceneParts* parts) : scene_(*scene), parts_(*parts) {}

  // Reads a directive: Texture "name" "kind" "type" parameters.
  void Define(Parameters& parameters, const std::string& name, const std::string& kind,
              const std::string& type, const Transform& to_world);

  // The node that a parameter of type "texture" names; fails if there is none.
  uint32_t Find(Parameters& parameters, const Parameter& parameter, TextureKind kind);
  // The node of a number, a colour or a texture; of `fallback` if the parameter is absent.
  uint32_t Input(Parameters& parameters, std::string_view name, TextureKind kind, float fallback);
  uint32_t Constant(const std::array<float, 3>& value);
  // The row of the scene's images; each file is read once for each use.
  uint32_t Image(Parameters& parameters, const Parameter& file, TextureKind kind,
                 const Encoding& encoding);

  // The node of a row of the scene's images that holds normals.
  uint32_t NormalMap(uint32_t image);

  const TextureStep& node(uint32_t index) const { return scene_.texture_nodes[index]; }
  size_t StepCount(uint32_t node) const { return NodesBelow(scene_.texture_nodes, node).size(); }

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

  Scene& scene_;
  SceneParts& parts_;
  std::map<std::pair<TextureKind, std::string>, uint32_t, std::less<>> nodes_;
  std::map<std::tuple<std::string, TextureKind, int, float>, uint32_t> images_;
};

}  // namespace swell

#endif  // SWELL_IMPORT_TEXTURES_H_
