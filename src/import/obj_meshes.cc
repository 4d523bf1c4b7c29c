// Merges corners that are alike: a chain of vertices for each position.
#include "src/import/obj_meshes.h"

#include "kernels/scene_view.h"

namespace swell {
namespace {

// Vertices at one position that are looked through before another one like them is made; bounds
// what a fan of a million normals around one point costs.
constexpr int kMostCompared = 64;

void AppendRow(const std::vector<float>& from, size_t row, size_t width, std::vector<float>* to) {
  const float* values = from.data() + width * row;
  to->insert(to->end(), values, values + width);
}

}  // namespace

VertexMerger::VertexMerger(const ObjGeometry& geometry)
    : geometry_(geometry), first_(geometry.positions.size() / 3, kNone) {}

uint32_t VertexMerger::Find(uint32_t position, uint32_t uv, uint32_t normal) {
  int compared = 0;
  for (uint32_t i = first_[position]; i != kNone && compared < kMostCompared; ++compared) {
    if (vertices_[i].uv == uv && vertices_[i].normal == normal) return i;
    i = vertices_[i].next;
  }
  vertices_.push_back({uv, normal, first_[position]});
  positions_.push_back(position);
  first_[position] = static_cast<uint32_t>(vertices_.size() - 1);
  return first_[position];
}

void VertexMerger::Append(const ObjGroup& group, Scene* scene) {
  const auto base = static_cast<uint32_t>(scene->positions.size() / 3);
  const bool has_uvs = !group.uvs.empty(), has_normals = !group.normals.empty();
  vertices_.clear();
  positions_.clear();
  scene->indices.reserve(scene->indices.size() + group.positions.size());
  for (size_t i = 0; i < group.positions.size(); ++i) {
    scene->indices.push_back(base + Find(group.positions[i], has_uvs ? group.uvs[i] : 0,
                                         has_normals ? group.normals[i] : 0));
  }
  scene->positions.reserve(scene->positions.size() + 3 * vertices_.size());
  for (size_t i = 0; i < vertices_.size(); ++i) {
    AppendRow(geometry_.positions, positions_[i], 3, &scene->positions);
    if (has_uvs) AppendRow(geometry_.uvs, vertices_[i].uv, 2, &scene->uvs);
    if (has_normals) AppendRow(geometry_.normals, vertices_[i].normal, 3, &scene->normals);
    first_[positions_[i]] = kNone;
  }
}

}  // namespace swell
