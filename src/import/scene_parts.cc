// Has meshes made, and shifts the rows of parts to where they are in the whole scene.
#include "src/import/scene_parts.h"

#include <map>
#include <new>
#include <string>
#include <tuple>
#include <utility>

#include "src/scene/objects.h"

namespace swell {
namespace {

// Moves where it can: a scene of one part is not copied.
template <class T> void AppendRows(std::vector<T>& to, std::vector<T>& from) {
  if (to.empty() && to.capacity() <= from.capacity()) {
    to = std::move(from);
  } else {
    to.insert(to.end(), from.begin(), from.end());
  }
  from = {};
}

void PlaceMesh(const Placement& placement, SharedPly& ply, Scene& part, Diagnostics& diagnostics) {
  const MeshStart start = BeginMesh(part);
  const Result<PlyContents> contents = ply.Give(&part);
  if (!contents) {
    return diagnostics.Fail(placement.place, placement.name + ": " + contents.error().message);
  }
  if (contents->short_faces > 0) {
    diagnostics.Warn(placement.place, placement.name + ": " + ply.path() + ": " +
                                          std::to_string(contents->short_faces) +
                                          " faces of fewer than 3 vertices are left out");
  }
  Placement named = placement;
  named.name += " '" + ply.path() + "'";
  FinishMesh(part, diagnostics, named, start);
}

}  // namespace

void SceneParts::Append(Rows& part, Scene* scene) {
  const auto vertices = static_cast<uint32_t>(scene->positions.size() / 3);
  const auto triangles = static_cast<uint32_t>(scene->triangle_count());
  const auto shapes = static_cast<uint32_t>(scene->shapes.size());
  const auto spheres = static_cast<uint32_t>(scene->spheres.size());
  const uint32_t normals = static_cast<uint32_t>(scene->normals.size() / 3) - vertices;
  const uint32_t uvs = static_cast<uint32_t>(scene->uvs.size() / 2) - vertices;
  for (Shape& shape : part.shapes) {
    ShapeRecord& record = shape.record;
    if ((record.flags & kShapeIsSphere) != 0) {
      record.sphere += spheres;
    } else {
      record.first_prim += triangles;
    }
    if (record.normal_offset != kNone) record.normal_offset += normals;
    if (record.uv_offset != kNone) record.uv_offset += uvs;
  }
  if (vertices != 0) {
    for (uint32_t& index : part.indices) index += vertices;
  }
  if (shapes != 0) {
    for (uint32_t& shape : part.prim_shape) shape += shapes;
  }
  AppendRows(scene->positions, part.positions);
  AppendRows(scene->normals, part.normals);
  AppendRows(scene->uvs, part.uvs);
  AppendRows(scene->indices, part.indices);
  AppendRows(scene->prim_shape, part.prim_shape);
  AppendRows(scene->shapes, part.shapes);
  AppendRows(scene->spheres, part.spheres);
  scene->left_out_triangles += part.left_out_triangles;
}

SceneParts::Rows SceneParts::TakeRows(Scene& scene) {
  return {std::move(scene.positions), std::move(scene.normals),    std::move(scene.uvs),
          std::move(scene.indices),   std::move(scene.prim_shape), std::move(scene.shapes),
          std::move(scene.spheres),   scene.left_out_triangles};
}

SceneParts::Part& SceneParts::Begin(Place place) {
  open_ = false;
  Part& part = parts_.emplace_back();
  part.place = place;
  return part;
}

Scene& SceneParts::Open(Place place) {
  if (!open_) Begin(place).open = std::make_unique<Scene>();
  open_ = true;
  return *parts_.back().open;
}

void SceneParts::AddPly(const Placement& placement, const std::string& path) {
  Begin(placement.place).ply = std::make_unique<PlyUse>(PlyUse{placement, reads_.Ply(path)});
}

void SceneParts::AddImage(Place place, const std::string& prefix,
                          std::shared_ptr<SharedImage> image) {
  Begin(place).image = std::make_unique<ImageUse>(ImageUse{prefix, std::move(image)});
}

void SceneParts::AddImport(SceneParts* inner, Diagnostics* diagnostics) {
  Begin({}).import = std::make_unique<ImportUse>(ImportUse{inner, diagnostics});
}

size_t SceneParts::Close() {
  open_ = false;
  return parts_.size();
}

bool SceneParts::MayHoldShapes(size_t first) const {
  for (size_t i = first; i < parts_.size(); ++i) {
    const Part& part = parts_[i];
    if (part.open != nullptr ? !part.open->shapes.empty() : part.image == nullptr) return true;
  }
  return false;
}

void SceneParts::Map(const RowMap& map) {
  for (Part& part : parts_) {
    if (part.ply != nullptr) map.Map(&part.ply->placement);
    if (part.import != nullptr) part.import->parts->Map(map);
    if (part.open == nullptr) continue;
    for (Shape& shape : part.open->shapes) map.Map(&shape);
  }
}

void SceneParts::FindMeshes(std::vector<FoundMesh>* found) {
  for (size_t i = 0; i < parts_.size(); ++i) {
    if (parts_[i].ply != nullptr) found->push_back({this, i, parts_[i].ply.get()});
    if (parts_[i].import != nullptr) parts_[i].import->parts->FindMeshes(found);
  }
}

std::vector<SceneParts::SharedMesh> SceneParts::ShareMeshes(const MayShare& may_share) {
  std::vector<FoundMesh> found;
  FindMeshes(&found);
  using Surface = std::tuple<const SharedPly*, uint32_t, uint32_t, uint32_t, uint32_t, bool, bool>;
  std::map<Surface, size_t> group_of;
  std::vector<std::vector<FoundMesh>> groups;  // by what is found first
  for (const FoundMesh& mesh : found) {
    const Placement& p = mesh.use->placement;
    const SharedPly& ply = *mesh.use->ply;
    // No instance can be as flat or as large as a mesh can be in the world.
    if (ply.triangles() < kLeastSharedTriangles || p.in_object || !may_share(p) ||
        !PlaceObject(p.object_to_world.m, 0)) {
      continue;
    }
    const Surface surface{&ply,    p.material, p.alpha, p.inside, p.outside, p.reverse_orientation,
                          p.border};
    const auto [at, is_new] = group_of.try_emplace(surface, groups.size());
    if (is_new) groups.emplace_back();
    groups[at->second].push_back(mesh);
  }
  std::vector<SharedMesh> shared;
  for (const std::vector<FoundMesh>& group : groups) {
    if (group.size() < 2) continue;
    const FoundMesh& first = group[0];
    SharedMesh mesh{
        first.use->ply->path(), first.use->placement.place, first.parts, first.part, {}};
    for (const FoundMesh& each : group) {
      mesh.uses.push_back(each.use->placement.object_to_world);
      if (each.use == first.use) continue;
      each.use->ply->DropUse();
      each.parts->parts_[each.part].ply.reset();
    }
    first.use->placement.object_to_world = {};
    shared.push_back(std::move(mesh));
  }
  return shared;
}

void SceneParts::MakePly(Part* part) {
  Diagnostics diagnostics;
  try {
    Scene scene;
    const std::shared_ptr<SharedPly> ply = std::move(part->ply->ply);
    PlaceMesh(part->ply->placement, *ply, scene, diagnostics);
    part->rows = TakeRows(scene);
  } catch (const std::bad_alloc&) {
    diagnostics.Fail(part->place, "there is not enough memory for the file it names");
  }
  if (diagnostics.silent()) return;
  part->diagnostics = std::make_unique<Diagnostics>(std::move(diagnostics));
}

void SceneParts::BeginMaking() {
  for (Part& part : parts_) {
    if (part.open != nullptr) part.rows = TakeRows(*part.open);
    part.open.reset();
    if (part.ply != nullptr) reads_.Run([&part] { MakePly(&part); });
    if (part.import != nullptr) part.import->parts->BeginMaking();
  }
}

// A file whose last part is made is forgotten.
void SceneParts::MakeAll() {
  reads_.ForgetPlys();
  BeginMaking();
  reads_.Wait();
}

// Where it is named first.
void SceneParts::TellImage(Part* part) {
  SharedImage& image = *part->image->image;
  if (image.told) return;
  image.told = true;
  Diagnostics diagnostics;
  if (!image.image) {
    diagnostics.Fail(part->place, "there is not enough memory for the file it names");
  } else if (!*image.image) {
    diagnostics.Fail(part->place, part->image->prefix + image.image->error().message);
  } else if (image.not_finite > 0) {
    diagnostics.Warn(part->place, part->image->prefix + image.path + ": " +
                                      std::to_string(image.not_finite) +
                                      " values are not finite; they count as 0");
  }
  if (diagnostics.silent()) return;
  part->diagnostics = std::make_unique<Diagnostics>(std::move(diagnostics));
}

void SceneParts::Tell(Diagnostics* diagnostics) {
  for (Part& part : parts_) {
    if (part.image != nullptr) TellImage(&part);
    if (part.import != nullptr) part.import->parts->Tell(part.import->diagnostics);
    const Diagnostics* said =
        part.import != nullptr ? part.import->diagnostics : part.diagnostics.get();
    if (said == nullptr) continue;
    diagnostics->Take(*said);
    if (said->failed()) return;
  }
}

// What is reserved takes no memory before it is written, and parts go as it is.
void SceneParts::AddSizes(Sizes* sizes) const {
  for (const Part& part : parts_) {
    sizes->positions += part.rows.positions.size();
    sizes->normals += part.rows.normals.size();
    sizes->uvs += part.rows.uvs.size();
    sizes->indices += part.rows.indices.size();
    if (part.import != nullptr) part.import->parts->AddSizes(sizes);
  }
}

void SceneParts::AppendAll(Scene* scene, Diagnostics* diagnostics) {
  const auto begin_part = [&] {
    starts_.push_back({static_cast<uint32_t>(scene->triangle_count()),
                       static_cast<uint32_t>(scene->spheres.size()),
                       static_cast<uint32_t>(scene->shapes.size())});
  };
  for (Part& part : parts_) {
    begin_part();
    if (part.import != nullptr) part.import->parts->AppendAll(scene, diagnostics);
    if (diagnostics->failed()) return;
    if ((scene->positions.size() + part.rows.positions.size()) / 3 > kMaxVertices ||
        (scene->indices.size() + part.rows.indices.size()) / 3 > kMaxVertices) {
      return diagnostics->Fail(
          part.place,
          "the scene has more than " + std::to_string(kMaxVertices) + " vertices or triangles");
    }
    Append(part.rows, scene);
    part.rows = {};
  }
  begin_part();
  parts_.clear();
}

void SceneParts::Join(Scene* scene, Diagnostics* diagnostics) {
  Sizes sizes;
  AddSizes(&sizes);
  scene->positions.reserve(sizes.positions);
  scene->normals.reserve(sizes.normals);
  scene->uvs.reserve(sizes.uvs);
  scene->indices.reserve(sizes.indices);
  scene->prim_shape.reserve(sizes.indices / 3);
  AppendAll(scene, diagnostics);
}

}  // namespace swell
