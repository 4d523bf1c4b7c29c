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
  // Nothing ever scatters on an interface, but every shape has a row.
  const bool has_row = state_.material != kNoMaterial && state_.material != kInterfaceMaterial;
  return has_row ? state_.material : AddMaterial(DefaultMaterial("diffuse"));
}

void PbrtReader::Material(Place place) {
  const std::string type = Text("the material's type");
  Parameters parameters = ParseParameters(place, "Material '" + type + "'", Target::kMaterial);
  if (failed()) return;
  if (IsInterfaceMaterial(type)) {
    state_.material = kInterfaceMaterial;
    return;
  }
  if (type == "mix") {
    state_.material = AddMix(parameters, "");
    return;
  }
  const swell::Material material = ReadMaterial(parameters, type);
  if (!failed()) state_.material = AddMaterial(material);
}

// A mix of two named materials has a row of its own kind.
uint32_t PbrtReader::AddMix(Parameters& parameters, const std::string& name) {
  Mix mix;
  mix.name = name;
  const Parameter* names = parameters.Any("materials");
  if (names == nullptr || names->type != "string" || names->strings.size() != 2) {
    parameters.Fail(parameters.place(), "needs \"string materials\" with two names");
    return kNoMaterial;
  }
  for (size_t i = 0; i < 2; ++i) {
    mix.materials[i] = NamedIndex(names->strings[i], names->place);
    if (mix.materials[i] != kInterfaceMaterial) continue;
    parameters.Fail(names->place, "an interface cannot be mixed");
    return kNoMaterial;
  }
  Parameter* amount = parameters.Any("amount");
  if (amount != nullptr && amount->type == "texture") {
    mix.amount_texture = textures_.Find(parameters, *amount, TextureKind::kFloat);
  } else {
    mix.amount = parameters.FloatWithin("amount", mix.amount, 0.0f, 1.0f);
  }
  parameters.ReportUnknown();
  scene_.mixes.push_back(mix);
  return kMixedMaterial | static_cast<uint32_t>(scene_.mixes.size() - 1);
}

// Null, and an error, if there is one of that name.
PbrtReader::NamedMaterial* PbrtReader::BeginMaterial(const std::string& name, Place place) {
  NamedMaterial& named = named_[name];
  if (named.defined()) {
    Fail(place, "material " + Quote(name) + " is defined twice; the other is in " +
                    ToString(named.definition));
    return nullptr;
  }
  named.definition = place;
  return &named;
}

void PbrtReader::DefineMaterial(NamedMaterial* named, const swell::Material& material) {
  if (named->index == kNoMaterial) {
    named->index = AddMaterial(material);
  } else {
    scene_.materials[named->index] = material;
  }
}

void PbrtReader::DefineOther(NamedMaterial* named, const std::string& name, uint32_t index) {
  if (named->index != kNoMaterial) {
    return Fail(named->first_use, "material " + Quote(name) + " is " +
                                      (index == kInterfaceMaterial ? "an interface" : "a mix") +
                                      "; define it before it is used");
  }
  named->index = index;
}

void PbrtReader::MakeNamedMaterial(Place place) {
  const std::string name = Text("the material's name");
  Parameters parameters = ParseParameters(place, "material '" + name + "'", Target::kMaterial);
  const std::string type = parameters.String("type", "");
  if (failed()) return;
  NamedMaterial* named = BeginMaterial(name, place);
  if (named == nullptr) return;
  if (parameters.Any("type") == nullptr) {
    return Fail(place, "material " + Quote(name) + " has no \"string type\"");
  }
  if (IsInterfaceMaterial(type)) return DefineOther(named, name, kInterfaceMaterial);
  if (type == "mix") {
    const bool used = named->index != kNoMaterial;
    const uint32_t index = used ? 0 : AddMix(parameters, name);
    if (failed()) return;
    if (!used && named->index != kNoMaterial) {
      return Fail(place, "the mix " + Quote(name) + " holds itself");
    }
    return DefineOther(named, name, index);
  }
  swell::Material material = ReadMaterial(parameters, type);
  material.name = name;
  if (!failed()) DefineMaterial(named, material);
}

// pbrt resolves names at the end of the scene, so a use may come before the definition.
uint32_t PbrtReader::NamedIndex(const std::string& name, Place place) {
  NamedMaterial& named = named_[name];
  if (named.index == kNoMaterial) {
    swell::Material placeholder;
    placeholder.name = name;
    named.index = AddMaterial(placeholder);
    named.first_use = place;
  }
  return named.index;
}

// Surfaces of materials that glow are lights, unless they are in objects or have a light of their
// own. Materials may be defined after their uses.
void PbrtReader::FinishGlow() {
  std::vector<bool> in_object(scene_.shapes.size());
  for (const ObjectParts& object : object_parts_) {
    const uint32_t end = object.parts->start(object.end).shape;
    for (uint32_t i = object.parts->start(object.first).shape; i < end; ++i) in_object[i] = true;
  }
  for (uint32_t i = 0; i < scene_.shapes.size(); ++i) {
    swell::Shape& shape = scene_.shapes[i];
    const uint32_t material = shape.record.material;
    if (in_object[i] || shape.emits || shape.border || material >= scene_.materials.size()) {
      continue;
    }
    shape.radiance = EmittedRadiance(scene_.materials[material]);
    shape.emits = shape.radiance != std::array<float, 3>{};
  }
}

void PbrtReader::UseNamedMaterial(Place place) {
  const std::string name = Text("the material's name");
  if (!failed()) state_.material = NamedIndex(name, place);
}

}  // namespace swell
