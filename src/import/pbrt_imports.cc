// Import: a file is read by a task, into tables of its own, with a copy of the state at its
// directive; then its tables are appended to those of the file that imports it.
#include <new>

#include "src/import/pbrt_directives.h"

namespace swell {

struct PbrtReader::ImportedFile {
  ImportedFile(PbrtReader& outer, Place place) : reader(&scene, outer, place) {}

  Scene scene;
  PbrtReader reader;
};

PbrtReader::PbrtReader(Scene* scene, SharedReads* reads)
    : scene_(*scene),
      reads_(*reads),
      tokens_(&diagnostics_, {{}, reads->opened()}),
      parts_(reads),
      textures_(scene, &parts_, reads, nullptr) {}

PbrtReader::PbrtReader(Scene* scene, PbrtReader& outer, Place place)
    : scene_(*scene),
      reads_(outer.reads_),
      tokens_(&diagnostics_, outer.tokens_.Chain()),
      parts_(&reads_),
      textures_(scene, &parts_, &reads_, outer.textures_.Defined()),
      main_folder_(outer.main_folder_),
      in_world_(true),
      last_place_(place),
      state_(outer.state_),
      is_import_(true),
      systems_(outer.systems_) {
  if (state_.material < kInterfaceMaterial) {
    outer_material_ = state_.material;
    state_.material = 0;
    scene_.materials.emplace_back();
  }
  if (state_.emission.image != kNoTexture) {
    outer_image_light_ = state_.emission.image;
    state_.emission.image = 0;
    scene_.image_lights.emplace_back();
  }
  for (uint32_t* medium : {&state_.inside, &state_.outside}) {
    if (*medium == kVacuum) continue;
    const std::string& name = outer.scene_.media[*medium].name;
    *medium = MediumOf(name, outer.media_.at(name).first_use).row;
  }
  // What becomes of a shape depends on whether its material is one; other names can wait.
  for (const auto& [name, named] : outer.named_) {
    if (named.index == kInterfaceMaterial) named_.emplace(name, named);
  }
  if (!outer.in_object()) return;
  const ObjectDefinition& object = outer.objects_[outer.open_object_];
  open_object_ = DefinitionOf(object.name, object.place);
}

PbrtReader::~PbrtReader() = default;

void PbrtReader::Import(Place place) {
  const std::string path = FileNamedBy(place, "Import");
  if (failed()) return;
  imports_.push_back(std::make_unique<ImportedFile>(*this, place));
  PbrtReader& reader = imports_.back()->reader;
  parts_.AddImport(&reader.parts_, &reader.diagnostics_);
  if (in_object()) objects_[open_object_].imports = true;
  reads_.Run([&reader, path, place] { reader.ReadImported(path, place); });
}

void PbrtReader::ReadImported(const std::string& path, Place place) {
  try {
    tokens_.Open(path, place);
    ReadDirectives();
    if (!saved_.empty()) {
      Fail(saved_.back().place, std::string(saved_.back().directive) + " is never closed");
    }
  } catch (const std::bad_alloc&) {
    Fail(place, "there is not enough memory for the file it names");
  }
  tokens_.Close();
}

bool PbrtReader::AllRead() const {
  for (const auto& file : imports_) {
    if (!file->reader.AllRead()) return false;
  }
  return !failed();
}

void PbrtReader::AbsorbImports() {
  for (const auto& file : imports_) {
    file->reader.AbsorbImports();
    if (!file->reader.failed()) Absorb(file.get());
    if (failed() || file->reader.failed()) return;
  }
}

void PbrtReader::Absorb(ImportedFile* file) {
  RowMap map;
  textures_.Absorb(file->reader.textures_, &map);
  AbsorbLights(&file->reader, &map);
  AbsorbMedia(file->reader, &map);
  AbsorbMaterials(file->reader, &map);
  AbsorbMixes(file->reader, &map);
  AbsorbObjects(file->reader);
  if (failed()) return;
  file->reader.parts_.Map(map);
  file->scene = {};
}

void PbrtReader::AbsorbLights(PbrtReader* inner, RowMap* map) {
  for (ImageLight& light : inner->scene_.image_lights) {
    const bool is_outer = map->image_lights.empty() && inner->outer_image_light_ != kNoTexture;
    map->image_lights.push_back(is_outer ? inner->outer_image_light_
                                         : static_cast<uint32_t>(scene_.image_lights.size()));
    if (!is_outer) scene_.image_lights.push_back(std::move(light));
  }
  for (LightRecord light : inner->scene_.lights) {
    light.image = map->ImageLight(light.image);
    scene_.lights.push_back(light);
  }
}

void PbrtReader::AbsorbMedia(const PbrtReader& inner, RowMap* map) {
  map->media.assign(inner.scene_.media.size(), kVacuum);
  for (const auto& [name, medium] : inner.media_) {
    map->media[medium.row] = MediumOf(name, medium.first_use).row;
    if (!medium.defined()) continue;
    DefineMedium(name, medium.definition, inner.scene_.media[medium.row].absorption);
  }
}

void PbrtReader::AbsorbMaterials(const PbrtReader& inner, RowMap* map) {
  std::map<uint32_t, const std::pair<const std::string, NamedMaterial>*> named_rows;
  for (const auto& entry : inner.named_) named_rows.emplace(entry.second.index, &entry);
  for (uint32_t row = 0; row < inner.scene_.materials.size(); ++row) {
    if (row == 0 && inner.outer_material_ != kNoMaterial) {
      map->materials.push_back(inner.outer_material_);
      continue;
    }
    swell::Material material = inner.scene_.materials[row];
    for (MaterialTexture& texture : material.textures) texture.node = map->Node(texture.node);
    material.displacement = map->Node(material.displacement);
    material.normal_map = map->Node(material.normal_map);
    const auto found = named_rows.find(row);
    if (found == named_rows.end()) {
      map->materials.push_back(AddMaterial(material));
      continue;
    }
    const auto& [name, named] = *found->second;
    if (named.defined()) {
      NamedMaterial* own = BeginMaterial(name, named.definition);
      if (own == nullptr) return;
      DefineMaterial(own, material);
    }
    map->materials.push_back(NamedIndex(name, named.first_use));
    if (map->materials.back() == kInterfaceMaterial) {
      return Fail(named.first_use,
                  "material " + Quote(name) + " is an interface; define it before it is used");
    }
  }
}

// Mixes hold materials and earlier mixes only. Interfaces have no rows.
void PbrtReader::AbsorbMixes(const PbrtReader& inner, RowMap* map) {
  if (failed()) return;
  map->first_mix = static_cast<uint32_t>(scene_.mixes.size());
  for (Mix mix : inner.scene_.mixes) {
    for (uint32_t& material : mix.materials) material = map->Material(material);
    mix.amount_texture = map->Node(mix.amount_texture);
    scene_.mixes.push_back(mix);
  }
  for (const auto& [name, named] : inner.named_) {
    if (named.index < kMixedMaterial || failed()) continue;
    const bool interface = named.index == kInterfaceMaterial;
    const auto own = named_.find(name);
    const bool copied = own != named_.end() && own->second.index == kInterfaceMaterial &&
                        own->second.definition.file == named.definition.file &&
                        own->second.definition.line == named.definition.line;
    if (interface && copied) continue;
    NamedMaterial* defined = BeginMaterial(name, named.definition);
    if (defined == nullptr) return;
    DefineOther(defined, name, interface ? named.index : map->Material(named.index));
  }
}

void PbrtReader::AbsorbObjects(const PbrtReader& inner) {
  if (failed()) return;
  std::vector<uint32_t> numbers;
  for (const ObjectDefinition& object : inner.objects_) {
    numbers.push_back(DefinitionOf(object.name, object.place));
  }
  const auto add_uses = [&](const std::vector<ObjectUse>& from, std::vector<ObjectUse>* to) {
    for (ObjectUse use : from) {
      use.definition = numbers[use.definition];
      to->push_back(use);
    }
  };
  const auto first_row = static_cast<uint32_t>(scene_.objects.size());
  for (size_t i = 0; i < numbers.size(); ++i) {
    const ObjectDefinition& object = inner.objects_[i];
    ObjectDefinition& own = objects_[numbers[i]];
    add_uses(object.uses, &own.uses);
    own.imports = own.imports || object.imports;
    if (!object.defined) continue;
    if (own.defined) {
      return Fail(object.place, "object " + Quote(object.name) + " is already defined at " +
                                    ToString(own.place) + "; give one of them another name");
    }
    own.defined = true;
    own.place = object.place;
    if (object.object != kNone) own.object = first_row + object.object;
  }
  add_uses(inner.waiting_uses_, &waiting_uses_);
  scene_.objects.insert(scene_.objects.end(), inner.scene_.objects.begin(),
                        inner.scene_.objects.end());
  object_parts_.insert(object_parts_.end(), inner.object_parts_.begin(), inner.object_parts_.end());
}

}  // namespace swell
