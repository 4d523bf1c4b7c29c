// Directives of materials -> rows of the scene, those of equal words only once.
#include "src/import/pbrt_directives.h"

#include "src/import/materials.h"

namespace swell {

// Unnamed materials with the same words are one: runs of rows get longer.
uint32_t PbrtReader::AddMaterial(const swell::Material& material) {
  const auto next = static_cast<uint32_t>(scene_.materials.size());
  const bool constant = material.textures.empty() && material.displacement == kNoTexture &&
                        material.normal_map == kNoTexture;
  if (material.name.empty() && constant) {
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

}  // namespace swell
