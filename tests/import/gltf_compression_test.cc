// glTF meshes that are compressed by Draco and meshoptimizer, encoded here by the same libraries.
#include <draco/compression/expert_encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <meshoptimizer.h>

#include "tests/import/gltf_texts.h"

namespace swell {
namespace {

using test::CheckGltfError;
using test::GltfData;
using test::GltfScene;

// Two triangles with positions as attribute 0, as Draco's bytes.
std::string DracoSquare() {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(2);
  const int positions =
      builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const float p[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  builder.SetAttributeValuesForFace(positions, draco::FaceIndex(0), p[0], p[1], p[2]);
  builder.SetAttributeValuesForFace(positions, draco::FaceIndex(1), p[0], p[2], p[3]);
  const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
  draco::ExpertEncoder encoder(*mesh);
  draco::EncoderBuffer buffer;
  REQUIRE(encoder.EncodeToBuffer(&buffer).ok());
  return {buffer.data(), buffer.size()};
}

std::string DracoJson(const std::string& bytes) {
  GltfData data;
  const size_t view = data.View(std::vector<char>(bytes.begin(), bytes.end()));
  data.accessors = {"{" + GltfData::Members(5126, 4, "VEC3") + "}",
                    "{" + GltfData::Members(5125, 6, "SCALAR") + "}"};
  return data.Json(
      "\"extensionsRequired\":[\"KHR_draco_mesh_compression\"],\"meshes\":[{\"primitives\":[{"
      "\"attributes\":{\"POSITION\":0},\"indices\":1,\"extensions\":{"
      "\"KHR_draco_mesh_compression\":{\"bufferView\":" +
      std::to_string(view) + ",\"attributes\":{\"POSITION\":0}}}}]}]," + test::kOneNode);
}

double SurfaceArea(const Scene& scene) {
  double sum = 0;
  for (size_t i = 0; i < scene.indices.size(); i += 3) {
    const float* a = &scene.positions[3 * scene.indices[i]];
    const float* b = &scene.positions[3 * scene.indices[i + 1]];
    const float* c = &scene.positions[3 * scene.indices[i + 2]];
    sum += 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
  }
  return sum;
}

struct Packed {
  GltfData data;
  size_t vertex_bytes = 0, index_bytes = 0;
};

// A square whose vertices and indices are packed one after the other.
Packed MeshoptSquare() {
  const float positions[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  const std::vector<uint32_t> indices = {0, 1, 2, 0, 2, 3};
  std::vector<unsigned char> vertices(meshopt_encodeVertexBufferBound(4, 12));
  vertices.resize(meshopt_encodeVertexBuffer(vertices.data(), vertices.size(), positions, 4, 12));
  std::vector<unsigned char> corners(meshopt_encodeIndexBufferBound(6, 4));
  corners.resize(meshopt_encodeIndexBuffer(corners.data(), corners.size(), indices.data(), 6));
  Packed packed;
  packed.vertex_bytes = vertices.size();
  packed.index_bytes = corners.size();
  packed.data.bytes.assign(vertices.begin(), vertices.end());
  packed.data.bytes.append(corners.begin(), corners.end());
  return packed;
}

std::string MeshoptView(size_t offset, size_t length, size_t stride, size_t count,
                        const std::string& mode, size_t size) {
  return "{\"buffer\":0,\"byteLength\":" + std::to_string(size) +
         ",\"extensions\":{\"EXT_meshopt_compression\":{\"buffer\":0,\"byteOffset\":" +
         std::to_string(offset) + ",\"byteLength\":" + std::to_string(length) +
         ",\"byteStride\":" + std::to_string(stride) + ",\"count\":" + std::to_string(count) +
         ",\"mode\":\"" + mode + "\"}}}";
}

std::string MeshoptJson(GltfData data) {
  data.accessors = {"{\"bufferView\":0," + GltfData::Members(5126, 4, "VEC3") + "}",
                    "{\"bufferView\":1," + GltfData::Members(5125, 6, "SCALAR") + "}"};
  return data.Json(
      "\"extensionsRequired\":[\"EXT_meshopt_compression\"],\"meshes\":[{\"primitives\":[{"
      "\"attributes\":{\"POSITION\":0},\"indices\":1}]}]," +
      test::kOneNode);
}

}  // namespace

TEST_CASE("glTF: a mesh compressed by Draco is decoded") {
  const Scene scene = GltfScene(DracoJson(DracoSquare()));
  CHECK(scene.triangle_count() == 2);
  CHECK(SurfaceArea(scene) == doctest::Approx(1.0));
  CHECK(scene.warnings.empty());
}

TEST_CASE("glTF: Draco's data is refused wherever it is cut off") {
  const std::string whole = DracoSquare();
  for (size_t size = 1; size < whole.size(); ++size) {
    CheckGltfError(DracoJson(whole.substr(0, size)), "KHR_draco_mesh_compression");
  }
}

TEST_CASE("glTF: a mesh compressed by meshoptimizer is decoded") {
  Packed packed = MeshoptSquare();
  packed.data.views = {MeshoptView(0, packed.vertex_bytes, 12, 4, "ATTRIBUTES", 48),
                       MeshoptView(packed.vertex_bytes, packed.index_bytes, 4, 6, "TRIANGLES", 24)};
  const Scene scene = GltfScene(MeshoptJson(packed.data));
  CHECK(scene.triangle_count() == 2);
  CHECK(SurfaceArea(scene) == doctest::Approx(1.0));
}

TEST_CASE("glTF: meshoptimizer's data that is damaged or lies about itself is refused") {
  const Packed packed = MeshoptSquare();
  const auto check = [&](const std::string& view, std::string_view fragment) {
    GltfData data = packed.data;
    data.views = {view, view};
    CheckGltfError(MeshoptJson(data), fragment);
  };
  const size_t length = packed.vertex_bytes;
  check(MeshoptView(0, length - 1, 12, 4, "ATTRIBUTES", 48), "damaged");
  check(MeshoptView(1, length - 1, 12, 4, "ATTRIBUTES", 48), "damaged");
  check(MeshoptView(0, 100000, 12, 4, "ATTRIBUTES", 48), "lie beyond");
  check(MeshoptView(0, length, 13, 4, "ATTRIBUTES", 48), "\"byteStride\" is 13");
  check(MeshoptView(0, length, 260, 4, "ATTRIBUTES", 48), "\"byteStride\" is 260");
  check(MeshoptView(0, length, 256, 2000000000, "ATTRIBUTES", 48), "more memory");
  check(MeshoptView(0, length, 12, 6, "TRIANGLES", 48), "\"byteStride\" is 12");
  check(MeshoptView(0, length, 4, 7, "TRIANGLES", 48), "no multiple of 3");
  check(MeshoptView(0, length, 4, 6, "MORTON", 48), "unknown mode 'MORTON'");
}

}  // namespace swell
