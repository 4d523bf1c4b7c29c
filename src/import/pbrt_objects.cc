// Objects and their instances -> the scene's two levels: what objects contain of other objects is
// placed directly in the world, once for every way that leads there.
#include <algorithm>
#include <numeric>
#include <utility>

#include "src/base/suggest.h"
#include "src/import/materials.h"
#include "src/import/pbrt_directives.h"
#include "src/import/pbrt_reader.h"
#include "src/scene/objects.h"

namespace swell {

uint32_t PbrtReader::DefinitionOf(const std::string& name, Place place) {
  const auto [at, is_new] = object_names_.try_emplace(name, static_cast<uint32_t>(objects_.size()));
  if (is_new) {
    objects_.push_back({});
    objects_.back().name = name;
    objects_.back().place = place;
  }
  return at->second;
}

void PbrtReader::ObjectBegin(Place place) {
  const std::string name = Text("the object's name");
  if (failed()) return;
  if (in_object()) {
    const ObjectDefinition& open = objects_[open_object_];
    return Fail(place, "ObjectBegin inside of another object, " + Quote(open.name) + " of " +
                           ToString(open.place) +
                           "; close that first and place it here with "
                           "ObjectInstance");
  }
  const uint32_t number = DefinitionOf(name, place);
  ObjectDefinition& definition = objects_[number];
  if (definition.defined) {
    return Fail(place, "object " + Quote(name) + " is already defined at " +
                           ToString(definition.place) + "; give one of them another name");
  }
  Push(place, "ObjectBegin");
  definition.place = place;
  definition.defined = true;
  open_object_ = number;
  open_part_ = parts_.Close();
}

void PbrtReader::ObjectEnd(Place place) {
  Pop(place, "ObjectBegin", "ObjectEnd");
  if (failed()) return;
  ObjectDefinition& definition = objects_[open_object_];
  const size_t end = parts_.Close();
  if (parts_.MayHoldShapes(open_part_)) {
    definition.object = static_cast<uint32_t>(scene_.objects.size());
    scene_.objects.push_back({definition.name});
    object_parts_.push_back({&parts_, open_part_, end});
  } else if (definition.uses.empty()) {
    Warn(definition.place, "object " + Quote(definition.name) + " has no shapes");
  }
  CompleteObject(open_object_, 0, false);
  open_object_ = kNone;
}

void PbrtReader::ObjectInstance(Place place) {
  const std::string name = Text("the object's name");
  if (failed()) return;
  const ObjectUse use = {DefinitionOf(name, place), state_.to_world, place};
  if (in_object()) {
    objects_[open_object_].uses.push_back(use);
  } else if (objects_[use.definition].complete && !is_import_) {
    PlaceUse(use);
  } else {
    waiting_uses_.push_back(use);
  }
}

// Counts what an object makes, once all that it contains is known. False if it is not, or wrong;
// the `last` time, what is not known is wrong too.
bool PbrtReader::CompleteObject(uint32_t number, uint32_t level, bool last) {
  ObjectDefinition& definition = objects_[number];
  if (definition.complete) return true;
  if (level > kMaxObjectDepth) return FailNesting(definition);
  if (!last && (!definition.defined || definition.imports)) return false;
  if (!definition.defined) {
    std::vector<std::string_view> names;
    for (const ObjectDefinition& object : objects_) {
      if (object.defined) names.push_back(object.name);
    }
    Fail(definition.place, "object " + Quote(definition.name) + " is not defined" +
                               DidYouMean(definition.name, names));
    return false;
  }
  definition.on_path = true;
  uint64_t instances = definition.object == kNone ? 0 : 1;
  uint32_t depth = 0;
  bool complete = true;
  for (const ObjectUse& use : definition.uses) {
    const ObjectDefinition& inner = objects_[use.definition];
    if (inner.on_path) {
      Fail(use.place, "object " + Quote(inner.name) + " contains itself" +
                          (use.definition == number ? "" : ", through " + Quote(definition.name)));
    }
    if (failed() || !CompleteObject(use.definition, level + 1, last)) {
      complete = false;
      break;
    }
    instances = std::min<uint64_t>(instances + inner.instances, uint64_t{kMaxInstances} + 1);
    depth = std::max(depth, inner.depth + 1);
  }
  definition.on_path = false;
  if (complete && depth > kMaxObjectDepth) return FailNesting(definition);
  definition.instances = instances;
  definition.depth = depth;
  definition.complete = complete;
  return complete;
}

bool PbrtReader::FailNesting(const ObjectDefinition& definition) {
  Fail(definition.place,
       "objects are nested more than " + std::to_string(kMaxObjectDepth) + " deep");
  return false;
}

void PbrtReader::FailInstances(Place place) {
  Fail(place, "the scene has more than " + std::to_string(kMaxInstances) +
                  " instances; objects within objects multiply theirs");
}

void PbrtReader::PlaceUse(const ObjectUse& use) {
  if (scene_.instances.size() + objects_[use.definition].instances > kMaxInstances) {
    return FailInstances(use.place);
  }
  AddInstances(use.definition, use.to_parent, use.place);
}

void PbrtReader::AddInstances(uint32_t number, const swell::Transform& to_world, Place place) {
  const ObjectDefinition& definition = objects_[number];
  if (definition.object != kNone) {
    const auto instance = PlaceObject(to_world.m, definition.object);
    if (!instance) {
      return Fail(place, "the transform flattens object " + Quote(definition.name) +
                             "; use scales that are neither 0 nor beyond 1e15");
    }
    scene_.instances.push_back(*instance);
  }
  for (const ObjectUse& use : definition.uses) {
    AddInstances(use.definition, to_world * use.to_parent, place);
    if (failed()) return;
  }
}

// Surfaces that shine stay in the world, where they are lights.
void PbrtReader::ShareMeshes() {
  const auto may_share = [&](const Placement& placement) {
    const uint32_t material = placement.material;
    return !placement.emission.emits &&
           (material >= scene_.materials.size() || placement.border ||
            EmittedRadiance(scene_.materials[material]) == std::array<float, 3>{});
  };
  for (const SceneParts::SharedMesh& mesh : parts_.ShareMeshes(may_share)) {
    if (scene_.instances.size() + mesh.uses.size() > kMaxInstances) {
      return FailInstances(mesh.place);
    }
    const auto object = static_cast<uint32_t>(scene_.objects.size());
    scene_.objects.push_back({mesh.name});
    object_parts_.push_back({mesh.parts, mesh.part, mesh.part + 1});
    for (const swell::Transform& to_world : mesh.uses) {
      scene_.instances.push_back(*PlaceObject(to_world.m, object));
    }
  }
}

// In the order of their ranges, which is not that of their rows if files were imported. Objects
// whose shapes came to nothing go, and so do their instances.
void PbrtReader::ArrangeObjects() {
  std::vector<uint32_t> order(scene_.objects.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    const Object &first = scene_.objects[a], &second = scene_.objects[b];
    return std::pair(first.first_triangle, first.first_sphere) <
           std::pair(second.first_triangle, second.first_sphere);
  });
  std::vector<uint32_t> row_of(scene_.objects.size(), kNone);
  std::vector<Object> kept;
  for (const uint32_t row : order) {
    Object& object = scene_.objects[row];
    if (object.triangle_count + object.sphere_count == 0) continue;
    row_of[row] = static_cast<uint32_t>(kept.size());
    kept.push_back(std::move(object));
  }
  scene_.objects = std::move(kept);
  const auto gone = std::remove_if(
      scene_.instances.begin(), scene_.instances.end(),
      [&](const InstanceRecord& instance) { return row_of[instance.object] == kNone; });
  scene_.instances.erase(gone, scene_.instances.end());
  for (InstanceRecord& instance : scene_.instances) instance.object = row_of[instance.object];
}

// Once all shapes are in the scene.
void PbrtReader::JoinObjects() {
  for (size_t i = 0; i < scene_.objects.size(); ++i) {
    const ObjectParts& parts = object_parts_[i];
    const SceneParts::Start& first = parts.parts->start(parts.first);
    const SceneParts::Start& end = parts.parts->start(parts.end);
    Object& object = scene_.objects[i];
    object.first_triangle = first.triangle;
    object.triangle_count = end.triangle - first.triangle;
    object.first_sphere = first.sphere;
    object.sphere_count = end.sphere - first.sphere;
  }
  ArrangeObjects();
}

void PbrtReader::FinishObjects() {
  for (uint32_t i = 0; i < objects_.size() && !failed(); ++i) CompleteObject(i, 0, true);
  for (const ObjectUse& use : waiting_uses_) {
    if (!failed()) PlaceUse(use);
  }
}

}  // namespace swell
