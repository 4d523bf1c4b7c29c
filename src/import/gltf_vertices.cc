// Attributes of a primitive's vertices -> rows of the scene.
#include <algorithm>
#include <cmath>

#include "src/import/append_mesh.h"
#include "src/import/gltf_meshes.h"

namespace swell {
namespace {

// Of rows of four; the gathers' offsets are 31 bits.
constexpr uint64_t kMaxColoredVertices = uint64_t{1} << 29, kMaxTangents = kMaxColoredVertices;

}  // namespace

// Null if there are none of this width for each vertex.
const GltfRows* GltfMeshes::RowsOf(const GltfPrimitive& read, const std::string& name, size_t width,
                                   size_t most) {
  const auto found = read.attributes.find(name);
  if (found == read.attributes.end()) return nullptr;
  const GltfRows& rows = found->second;
  const bool usable = rows.count() == read.attributes.at("POSITION").count() &&
                      rows.width >= width && rows.width <= std::max(width, most);
  return usable ? &rows : nullptr;
}

// Rows of a primitive, in its own space, behind those of the scene.
void GltfMeshes::Append(const GltfPrimitive& read, const std::optional<GltfUvFrame>& frame) {
  const size_t first = scene_.positions.size() / 3;
  const GltfRows& positions = read.attributes.at("POSITION");
  scene_.positions.insert(scene_.positions.end(), positions.values.begin(), positions.values.end());
  for (uint32_t index : read.indices) {
    scene_.indices.push_back(static_cast<uint32_t>(first + index));
  }
  if (const GltfRows* normals = RowsOf(read, "NORMAL", 3)) {
    scene_.normals.insert(scene_.normals.end(), normals->values.begin(), normals->values.end());
  }
  const GltfRows* uvs = frame ? RowsOf(read, UvName(frame->uv_set), 2) : nullptr;
  if (uvs != nullptr) AppendUvs(*uvs, frame->map);
  if (const GltfRows* colors = RowsOf(read, "COLOR_0", 3, 4)) AppendColors(*colors, first);
}

// As the scene has them: v upwards.
void GltfMeshes::AppendUvs(const GltfRows& uvs, const UvMap& map) {
  bool finite = true;
  const auto append = [&](double value) {
    const auto number = static_cast<float>(value);
    finite = finite && std::isfinite(number);
    scene_.uvs.push_back(std::isfinite(number) ? number : 0.0f);
  };
  for (size_t i = 0; i < uvs.count(); ++i) {
    const double u = uvs.values[2 * i], v = uvs.values[2 * i + 1];
    append(map.m[0] * u + map.m[1] * v + map.m[2]);
    append(1.0 - (map.m[3] * u + map.m[4] * v + map.m[5]));
  }
  if (!finite) {
    diagnostics_.Warn(place_, "texture coordinates that are not finite are 0 instead");
  }
}

// Vertices before that have no colour are white.
void GltfMeshes::AppendColors(const GltfRows& colors, size_t first_vertex) {
  if (first_vertex + colors.count() > kMaxColoredVertices) {
    return diagnostics_.Warn(place_, "colours of vertices beyond the first " +
                                         std::to_string(kMaxColoredVertices) + " are left out");
  }
  scene_.colors.resize(4 * first_vertex, 1.0f);
  for (size_t i = 0; i < colors.count(); ++i) {
    for (size_t c = 0; c < 4; ++c) {
      const float value = c < colors.width ? colors.values[i * colors.width + c] : 1.0f;
      scene_.colors.push_back(std::isfinite(value) ? value : 0.0f);
    }
  }
}

// What few meshes have, of the shape that was finished last.
void GltfMeshes::AppendRare(const GltfPrimitive& read, const GltfSurface& surface,
                            const Transform& to_world, const MeshStart& start) {
  const size_t first = start.positions / 3;
  Shape& shape = scene_.shapes.back();
  const auto offset = [&](size_t row) { return static_cast<uint32_t>(row - first); };
  if (surface.frames.second) {
    const GltfRows* uvs = RowsOf(read, UvName(surface.frames.second->uv_set), 2);
    if (uvs != nullptr) {
      shape.second_uv_offset = offset(scene_.uvs.size() / 2);
      AppendUvs(*uvs, surface.frames.second->map);
    }
  }
  const GltfRows* tangents = surface.tangents ? RowsOf(read, "TANGENT", 4) : nullptr;
  // By the specification they count with normals only.
  if (tangents == nullptr || shape.record.normal_offset == kNone) return;
  if (scene_.tangents.size() / 4 + tangents->count() > kMaxTangents) {
    return diagnostics_.Warn(
        place_, "tangents beyond the first " + std::to_string(kMaxTangents) + " are left out");
  }
  shape.tangent_offset = offset(scene_.tangents.size() / 4);
  const double mirror = Determinant(to_world) < 0.0 ? -1.0 : 1.0;
  for (size_t i = 0; i < tangents->count(); ++i) {
    const float* t = &tangents->values[4 * i];
    const auto along = Normalized(MapVector(to_world, {t[0], t[1], t[2]}));
    // Zero is none: the texture coordinates tell it there.
    AppendPoint(&scene_.tangents, along && std::isfinite(Dot(*along, *along)) ? *along : Point{});
    scene_.tangents.push_back(static_cast<float>(t[3] < 0.0f ? -mirror : mirror));
  }
}

}  // namespace swell
