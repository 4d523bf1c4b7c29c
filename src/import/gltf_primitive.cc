// A primitive of a glTF mesh -> rows of its vertices and triangles, compressed or not.
#include "src/import/gltf_primitive.h"

#include <algorithm>
#include <numeric>

#include "src/import/gltf_values.h"

namespace swell {
namespace {

bool HasTriangles(int mode) {
  return mode == TINYGLTF_MODE_TRIANGLES || mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
         mode == TINYGLTF_MODE_TRIANGLE_FAN;
}

// The corners of triangles from those of a list, a strip or a fan, by the specification.
std::vector<uint32_t> Triangulate(std::vector<uint32_t> corners, int mode, size_t* incomplete) {
  if (mode == TINYGLTF_MODE_TRIANGLES) {
    *incomplete = corners.size() % 3;
    corners.resize(corners.size() - *incomplete);
    return corners;
  }
  std::vector<uint32_t> triangles;
  const bool strip = mode == TINYGLTF_MODE_TRIANGLE_STRIP;
  for (size_t i = 0; i + 2 < corners.size(); ++i) {
    const size_t odd = strip ? i % 2 : 0;
    triangles.push_back(corners[strip ? i : i + 1]);
    triangles.push_back(corners[strip ? i + 1 + odd : i + 2]);
    triangles.push_back(corners[strip ? i + 2 - odd : 0]);
  }
  return triangles;
}

// The corners in order; all vertices if the primitive has no indices.
Result<std::vector<uint32_t>> ReadCorners(const GltfFile& file,
                                          const tinygltf::Primitive& primitive, uint64_t vertices) {
  if (primitive.indices < 0) {
    std::vector<uint32_t> all(vertices);
    std::iota(all.begin(), all.end(), 0u);
    return all;
  }
  Result<std::vector<uint32_t>> corners = ReadIndices(file, primitive.indices);
  if (!corners) return corners.error();
  const auto most = std::max_element(corners->begin(), corners->end());
  if (most != corners->end() && *most >= vertices) {
    return Error{"index " + std::to_string(*most) + " at position " +
                 std::to_string(most - corners->begin()) + " is beyond its " +
                 std::to_string(vertices) + " vertices"};
  }
  return corners;
}

}  // namespace

Result<GltfPrimitive> ReadPrimitive(const GltfFile& file, const tinygltf::Primitive& primitive,
                                    const std::vector<std::string>& names) {
  GltfPrimitive read;
  const auto position = primitive.attributes.find("POSITION");
  if (!HasTriangles(primitive.mode) || position == primitive.attributes.end()) return read;
  const tinygltf::Value* draco = FindExtension(primitive.extensions, "KHR_draco_mesh_compression");
  if (draco != nullptr) {
    Result<GltfPrimitive> decoded = ReadDracoPrimitive(file, *draco, names);
    if (!decoded) return Error{"KHR_draco_mesh_compression: " + decoded.error().message};
    return decoded;
  }
  const Result<uint64_t> vertices = CountRows(file, position->second);
  if (!vertices) return vertices.error();
  Result<std::vector<uint32_t>> corners = ReadCorners(file, primitive, *vertices);
  if (!corners) return corners.error();
  read.indices = Triangulate(std::move(*corners), primitive.mode, &read.incomplete);
  if (read.indices.empty()) return read;
  const auto [least, most] = std::minmax_element(read.indices.begin(), read.indices.end());
  const uint64_t first = *least, count = uint64_t{*most} - *least + 1;
  for (uint32_t& index : read.indices) index -= static_cast<uint32_t>(first);
  for (const std::string& name : names) {
    const auto attribute = primitive.attributes.find(name);
    if (attribute == primitive.attributes.end()) continue;
    Result<GltfRows> rows = ReadRows(file, attribute->second, first, count);
    if (!rows) return Error{name + ": " + rows.error().message};
    read.attributes[name] = std::move(*rows);
  }
  return read;
}

}  // namespace swell
