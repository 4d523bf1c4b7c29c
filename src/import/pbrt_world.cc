// Directives of lights, shapes and textures -> the scene.
#include "src/import/pbrt_directives.h"

#include "src/import/lights.h"
#include "src/import/materials.h"
#include "src/import/shape_reader.h"

namespace swell {

void PbrtReader::LightSource(Place place) {
  const std::string type = Text("the light's type");
  Parameters parameters = ParseParameters(place, "LightSource '" + type + "'", Target::kLight);
  if (failed()) return;
  if (in_object()) {
    Warn(place, "a light in an object is not instanced, as in pbrt; it shines once, where it is");
  }
  ReadLightSource(parameters, type, state_.to_world, &scene_);
}

void PbrtReader::AreaLightSource(Place place) {
  const std::string type = Text("the area light's type");
  Parameters parameters = ParseParameters(place, "AreaLightSource '" + type + "'", Target::kLight);
  if (!failed()) state_.emission = ReadAreaLight(parameters, type, &scene_);
}

void PbrtReader::Shape(Place place) {
  const std::string type = Text("the shape's type");
  Parameters parameters = ParseParameters(place, "Shape '" + type + "'", Target::kShape);
  if (failed()) return;
  Placement placement;
  placement.object_to_world = state_.to_world;
  placement.reverse_orientation = state_.reverse_orientation;
  placement.emission = state_.emission;
  placement.in_object = in_object();
  if (in_object() && state_.emission.emits) {
    Warn(place, "an area light in an object does not shine, as in pbrt; only its surface is there");
    placement.emission = {};
  }
  placement.place = place;
  placement.name = "Shape '" + type + "'";
  if (!Inverse(state_.to_world)) {
    return Fail(place, placement.name + ": the transform is singular; it flattens the shape");
  }
  // Light passes it unchanged; it may divide media.
  if (state_.material == kInterfaceMaterial) {
    if (state_.emission.emits) {
      Warn(place,
           "a surface of material 'interface' does not emit; its AreaLightSource is ignored");
    }
    placement.emission = {};
    if (state_.inside == state_.outside) return;
  }
  PlaceMedia(&placement);
  placement.material = CurrentMaterial();
  ReadShape(parameters, type, placement, &parts_);
}

void PbrtReader::Texture(Place place) {
  const std::string name = Text("the texture's name");
  const std::string kind = Text("the texture's kind");
  const std::string type = Text("the texture's type");
  Parameters parameters = ParseParameters(place, "Texture '" + name + "'", Target::kTexture);
  if (!failed()) textures_.Define(parameters, name, kind, type, state_.to_world);
}

}  // namespace swell
