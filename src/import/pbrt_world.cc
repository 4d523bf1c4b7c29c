// Directives of lights, shapes and textures -> the scene; those of media -> warnings.
#include "src/import/pbrt_directives.h"

#include "src/import/lights.h"
#include "src/import/materials.h"
#include "src/import/shape_reader.h"

namespace swell {

void PbrtReader::LightSource(Place place) {
  const std::string type = Text("the light's type");
  Parameters parameters = ParseParameters(place, "LightSource '" + type + "'");
  if (failed()) return;
  if (in_object()) {
    Warn(place, "a light in an object is not instanced, as in pbrt; it shines once, where it is");
  }
  ReadLightSource(parameters, type, state_.to_world, &scene_);
}

void PbrtReader::AreaLightSource(Place place) {
  const std::string type = Text("the area light's type");
  Parameters parameters = ParseParameters(place, "AreaLightSource '" + type + "'");
  if (!failed()) state_.emission = ReadAreaLight(parameters, type, &scene_);
}

void PbrtReader::Shape(Place place) {
  const std::string type = Text("the shape's type");
  Parameters parameters = ParseParameters(place, "Shape '" + type + "'");
  if (failed()) return;
  Placement placement;
  placement.object_to_world = state_.to_world;
  placement.reverse_orientation = state_.reverse_orientation;
  placement.emission = state_.emission;
  if (in_object() && state_.emission.emits) {
    Warn(place, "an area light in an object does not shine, as in pbrt; only its surface is there");
    placement.emission = {};
  }
  placement.place = place;
  placement.name = "Shape '" + type + "'";
  if (!Inverse(state_.to_world)) {
    return Fail(place, placement.name + ": the transform is singular; it flattens the shape");
  }
  // Light passes it unchanged, and media, whose border it would be, are not supported.
  if (state_.material == kInterfaceMaterial) {
    if (state_.emission.emits) {
      Warn(place,
           "a surface of material 'interface' does not emit; its AreaLightSource is ignored");
    }
    return;
  }
  placement.material = CurrentMaterial();
  const size_t first_shape = scene_.shapes.size();
  const bool may_glow =
      !in_object() && !state_.emission.emits && placement.material < scene_.materials.size();
  if (may_glow) {
    placement.emission.radiance = EmittedRadiance(scene_.materials[placement.material]);
    placement.emission.emits = placement.emission.radiance != std::array<float, 3>{};
  }
  ReadShape(parameters, type, placement, &scene_);
  if (!may_glow || !IsUndefined(placement.material)) return;
  for (size_t i = first_shape; i < scene_.shapes.size(); ++i) waiting_shapes_.push_back(i);
}

void PbrtReader::Texture(Place place) {
  const std::string name = Text("the texture's name");
  const std::string kind = Text("the texture's kind");
  const std::string type = Text("the texture's type");
  Parameters parameters = ParseParameters(place, "Texture '" + name + "'");
  if (!failed()) textures_.Define(parameters, name, kind, type, state_.to_world);
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

}  // namespace swell
