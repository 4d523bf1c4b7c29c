// Meshes of a glTF file, where its nodes place them -> shapes, objects and instances of the scene.
#include "src/import/gltf_meshes.h"

#include <cmath>

#include "src/base/available_memory.h"
#include "src/import/append_mesh.h"
#include "src/import/gltf_values.h"
#include "src/scene/objects.h"

namespace swell {
namespace {

constexpr uint64_t kBytesBetweenChecks = uint64_t{1} << 26;
constexpr double kMostOpening = 1e-3;  // of a volume's surface; closed ones have holes
constexpr int kMaxUvSets = 16;

bool Has(const tinygltf::Primitive& primitive, const std::string& attribute) {
  return primitive.attributes.count(attribute) != 0;
}

// The sets of texture coordinates of a primitive, by their numbers.
std::set<int> UvSets(const tinygltf::Primitive& primitive) {
  std::set<int> sets;
  for (int set = 0; set < kMaxUvSets; ++set) {
    if (Has(primitive, UvName(set))) sets.insert(set);
  }
  return sets;
}

}  // namespace

void GltfMeshes::Place(const std::vector<GltfPlacedNode>& nodes) {
  places_.resize(file_.model().meshes.size());
  for (const GltfPlacedNode& placed : nodes) {
    AddPlacements(placed);
    if (failed()) return;
  }
  for (size_t mesh = 0; mesh < places_.size() && !failed(); ++mesh) {
    if (!places_[mesh].empty()) AddMesh(static_cast<int>(mesh), places_[mesh]);
  }
  WarnOfTriangles();
}

void GltfMeshes::AddPlacements(const GltfPlacedNode& placed) {
  const tinygltf::Node& node = file_.model().nodes[static_cast<size_t>(placed.node)];
  if (node.mesh < 0) return;
  if (static_cast<size_t>(node.mesh) >= places_.size()) {
    return diagnostics_.Fail(place_, "there is no mesh " + std::to_string(node.mesh));
  }
  if (node.skin >= 0) {
    diagnostics_.Warn(place_, "skins are not supported; meshes stand as they were modelled");
  }
  std::vector<Transform>& places = places_[static_cast<size_t>(node.mesh)];
  const tinygltf::Value* instancing = FindExtension(node.extensions, "EXT_mesh_gpu_instancing");
  if (instancing == nullptr) return places.push_back(placed.to_world);
  const Result<std::vector<Transform>> copies = ReadInstancing(file_, *instancing);
  if (!copies) {
    return diagnostics_.Fail(place_, "node " + std::to_string(placed.node) +
                                         ", EXT_mesh_gpu_instancing: " + copies.error().message);
  }
  placement_count_ += copies->size();
  if (placement_count_ > kMaxInstances) {
    return diagnostics_.Fail(
        place_, "the scene has more than " + std::to_string(kMaxInstances) + " instances");
  }
  const uint64_t bytes = copies->size() * (sizeof(Transform) + sizeof(InstanceRecord));
  if (!CheckMemory(bytes, "its instances")) return;
  for (const Transform& copy : *copies) places.push_back(placed.to_world * copy);
}

void GltfMeshes::AddMesh(int mesh, const std::vector<Transform>& places) {
  if (places.size() == 1) return AddPrimitives(mesh, places[0], Which::kAll);
  const std::string& name = file_.model().meshes[static_cast<size_t>(mesh)].name;
  const size_t first_triangle = scene_.triangle_count();
  AddPrimitives(mesh, Transform{}, Which::kDark);
  if (failed()) return;
  if (scene_.triangle_count() > first_triangle) AddInstances(name, first_triangle, places);
  for (const Transform& to_world : places) {
    if (!failed()) AddPrimitives(mesh, to_world, Which::kBright);
  }
}

void GltfMeshes::AddInstances(const std::string& name, size_t first_triangle,
                              const std::vector<Transform>& places) {
  Object object;
  object.name = name;
  object.first_triangle = static_cast<uint32_t>(first_triangle);
  object.triangle_count = static_cast<uint32_t>(scene_.triangle_count() - first_triangle);
  scene_.objects.push_back(std::move(object));
  if (scene_.instances.size() + places.size() > kMaxInstances) {
    return diagnostics_.Fail(
        place_, "the scene has more than " + std::to_string(kMaxInstances) + " instances");
  }
  for (const Transform& to_world : places) {
    const auto instance = PlaceObject(to_world.m, static_cast<uint32_t>(scene_.objects.size() - 1));
    if (instance) {
      scene_.instances.push_back(*instance);
    } else {
      diagnostics_.Warn(place_,
                        "a node flattens its mesh, or scales it 1e15 times; it is left out");
    }
  }
}

void GltfMeshes::AddPrimitives(int mesh, const Transform& to_world, Which which) {
  const tinygltf::Mesh& source = file_.model().meshes[static_cast<size_t>(mesh)];
  const size_t first_shape = scene_.shapes.size();
  for (size_t i = 0; i < source.primitives.size() && !failed(); ++i) {
    std::string name = "mesh " + std::to_string(mesh);
    if (!source.name.empty()) name += " " + Quote(source.name);
    if (source.primitives.size() > 1) name += ", primitive " + std::to_string(i);
    AddPrimitive(source.primitives[i], name, to_world, which);
  }
  OpenVolumes(first_shape);
}

// Light that enters a volume through a sheet would never leave it: a mesh whose volumes are plainly
// not closed encloses nothing. The area vectors of a closed surface sum to zero.
void GltfMeshes::OpenVolumes(size_t first_shape) {
  Point sum{0, 0, 0};
  double sum_of_lengths = 0.0;
  bool any = false;
  for (size_t s = first_shape; s < scene_.shapes.size(); ++s) {
    if (scene_.shapes[s].inside == kVacuum) continue;
    any = true;
    const ShapeRecord& record = scene_.shapes[s].record;
    for (size_t i = record.first_prim; i < size_t{record.first_prim} + record.prim_count; ++i) {
      const uint32_t* corner = &scene_.indices[3 * i];
      const Point a = Row3(scene_.positions, corner[0]);
      const Point area = Cross(Minus(Row3(scene_.positions, corner[1]), a),
                               Minus(Row3(scene_.positions, corner[2]), a));
      for (size_t c = 0; c < 3; ++c) sum[c] += area[c];
      sum_of_lengths += std::sqrt(Dot(area, area));
    }
  }
  if (!any || std::sqrt(Dot(sum, sum)) <= kMostOpening * sum_of_lengths) return;
  diagnostics_.Warn(place_, "KHR_materials_volume: a mesh is not closed; it absorbs nothing");
  for (size_t s = first_shape; s < scene_.shapes.size(); ++s) scene_.shapes[s].inside = kVacuum;
}

void GltfMeshes::AddPrimitive(const tinygltf::Primitive& primitive, const std::string& name,
                              const Transform& to_world, Which which) {
  const GltfVertexData data{UvSets(primitive), Has(primitive, "COLOR_0")};
  const GltfSurface surface = materials_.Surface(primitive.material, data);
  if (failed()) return;
  if (which != Which::kAll && surface.emission.emits != (which == Which::kBright)) return;
  if (which != Which::kBright) WarnOfPrimitive(primitive);
  std::vector<std::string> names = {"POSITION", "NORMAL", "COLOR_0"};
  if (surface.tangents) names.push_back("TANGENT");
  for (const auto& frame : {surface.frames.first, surface.frames.second}) {
    if (frame) names.push_back(UvName(frame->uv_set));
  }
  const Result<GltfPrimitive> read = ReadPrimitive(file_, primitive, names);
  if (!read) return diagnostics_.Fail(place_, name + ": " + read.error().message);
  if (read->incomplete > 0) {
    diagnostics_.Warn(place_, name + ": the last " + std::to_string(read->incomplete) +
                                  " indices make no triangle and are left out");
  }
  if (read->indices.empty()) return;
  const auto position = read->attributes.find("POSITION");
  if (position == read->attributes.end() || position->second.width != 3) {
    return diagnostics_.Fail(place_, name + ": \"POSITION\" is missing or has not 3 components");
  }
  const uint64_t floats = position->second.count() * 18 + read->indices.size() * 2;
  if (!CheckMemory(floats * sizeof(float), name)) return;
  const MeshStart start = BeginMesh(scene_);
  const size_t shapes = scene_.shapes.size();
  Append(*read, surface.frames.first);
  Finish(surface, name, to_world, start);
  if (scene_.shapes.size() > shapes) AppendRare(*read, surface, to_world, start);
}

// As FinishMesh, but what it tells of each mesh is told once for all: files may have thousands.
void GltfMeshes::Finish(const GltfSurface& surface, const std::string& name,
                        const Transform& to_world, const MeshStart& start) {
  const size_t corners = scene_.indices.size() - start.indices;
  const bool has_normals = scene_.normals.size() > start.normals;
  Diagnostics of_mesh;
  Placement placement;
  placement.object_to_world = to_world;
  placement.material = surface.material;
  placement.emission = surface.emission;
  placement.alpha = surface.alpha;
  placement.inside = surface.inside;
  placement.place = {of_mesh.AddFile(name), 0};
  placement.name = "the mesh";
  FinishMesh(scene_, of_mesh, placement, start);
  if (of_mesh.failed()) return diagnostics_.Fail(place_, of_mesh.error().message);
  const size_t flat = (corners - (scene_.indices.size() - start.indices)) / 3;
  flat_triangles_ += flat;
  meshes_with_flat_ += flat > 0 ? 1 : 0;
  if (has_normals && scene_.normals.size() == start.normals) {
    diagnostics_.Warn(place_,
                      "a normal is zero or not finite; its mesh is rendered without its "
                      "normals");
  }
}

void GltfMeshes::WarnOfTriangles() {
  if (flat_triangles_ == 0) return;
  diagnostics_.Warn(place_, std::to_string(flat_triangles_) + " triangles without area, of " +
                                std::to_string(meshes_with_flat_) + " meshes, are left out");
}

// A small file may name the same data many times. False, with an error, if there is no room.
bool GltfMeshes::CheckMemory(uint64_t bytes, const std::string& what) {
  unchecked_bytes_ += bytes;
  if (unchecked_bytes_ < kBytesBetweenChecks) return true;
  unchecked_bytes_ = 0;
  if (bytes <= AvailableMemory()) return true;
  diagnostics_.Fail(place_, what + ": needs " + BytesForPeople(bytes) + " of memory");
  return false;
}

void GltfMeshes::WarnOfPrimitive(const tinygltf::Primitive& primitive) {
  if (primitive.mode >= TINYGLTF_MODE_POINTS && primitive.mode <= TINYGLTF_MODE_LINE_STRIP) {
    diagnostics_.Warn(place_, "points and lines are not supported and are left out");
  }
  if (!primitive.targets.empty()) {
    diagnostics_.Warn(place_, "morph targets are not supported; meshes keep their base shape");
  }
}

}  // namespace swell
