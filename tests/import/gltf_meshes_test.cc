// glTF meshes: accessors of every kind, modes of primitives, and what is refused of them.
#include <array>

#include "tests/import/gltf_texts.h"

namespace swell {
namespace {

using test::CheckGltfError;
using test::GltfData;
using test::GltfScene;

const std::vector<float> kCorners = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 2, 2, 2};

// A mesh of one primitive with these members.
std::string MeshJson(const GltfData& data, const std::string& primitive) {
  return data.Json("\"meshes\":[{\"primitives\":[{" + primitive + "}]}]," + test::kOneNode);
}

// Triangles of the scene as coordinates x y of their corners, times 10 and added.
std::vector<std::array<int, 3>> Corners(const Scene& scene) {
  std::vector<std::array<int, 3>> triangles;
  for (size_t i = 0; i < scene.indices.size(); i += 3) {
    std::array<int, 3> corners{};
    for (size_t k = 0; k < 3; ++k) {
      const float* p = &scene.positions[3 * scene.indices[i + k]];
      corners[k] = int(10 * p[0] + p[1]);
    }
    triangles.push_back(corners);
  }
  return triangles;
}

std::string PositionsAnd(size_t indices, int mode = 4) {
  return "\"attributes\":{\"POSITION\":0},\"indices\":" + std::to_string(indices) +
         ",\"mode\":" + std::to_string(mode);
}

template <class T> size_t AddIndices(GltfData& data, int component, const std::vector<T>& values) {
  return data.Accessor(data.View(values), GltfData::Members(component, values.size(), "SCALAR"));
}

}  // namespace

TEST_CASE("glTF: indices of 8, 16 and 32 bits, and none, make the same triangles") {
  GltfData data;
  data.Floats("VEC3", 3, kCorners);
  const size_t bytes = AddIndices<uint8_t>(data, 5121, {0, 1, 2});
  const size_t shorts = AddIndices<uint16_t>(data, 5123, {0, 1, 2});
  const size_t words = AddIndices<uint32_t>(data, 5125, {0, 1, 2});
  const std::vector<std::array<int, 3>> expected = {{0, 10, 11}};
  for (size_t indices : {bytes, shorts, words}) {
    const Scene scene = GltfScene(MeshJson(data, PositionsAnd(indices)));
    CHECK(Corners(scene) == expected);
    CHECK(scene.warnings.empty());
  }
  GltfData three;
  three.Floats("VEC3", 3, {0, 0, 0, 1, 0, 0, 1, 1, 0});
  CHECK(Corners(GltfScene(MeshJson(three, "\"attributes\":{\"POSITION\":0}"))) == expected);
}

TEST_CASE("glTF: strips alternate their winding and fans share their first corner") {
  GltfData data;
  data.Floats("VEC3", 3, {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
  const size_t strip = data.Indices({0, 1, 3, 2}), fan = data.Indices({0, 1, 2, 3});
  const std::vector<std::array<int, 3>> of_strip = {{0, 10, 1}, {10, 11, 1}};
  const std::vector<std::array<int, 3>> of_fan = {{10, 11, 0}, {11, 1, 0}};
  CHECK(Corners(GltfScene(MeshJson(data, PositionsAnd(strip, 5)))) == of_strip);
  CHECK(Corners(GltfScene(MeshJson(data, PositionsAnd(fan, 6)))) == of_fan);
}

TEST_CASE("glTF: points and lines are left out with one warning") {
  GltfData data;
  data.Floats("VEC3", 3, kCorners);
  data.Indices({0, 1, 2});
  const Scene scene = GltfScene(data.Json("\"meshes\":[{\"primitives\":[{" + PositionsAnd(1, 0) +
                                          "},{" + PositionsAnd(1, 1) + "},{" + PositionsAnd(1, 2) +
                                          "},{" + PositionsAnd(1, 3) + "}]}]," + test::kOneNode));
  CHECK(scene.triangle_count() == 0);
  CHECK(test::CountWarnings(scene, "points and lines") == 1);
  CHECK(test::CountWarnings(scene, "(and 3 more like it)") == 1);
}

TEST_CASE("glTF: indices that make no whole triangle are left out with a warning") {
  GltfData data;
  data.Floats("VEC3", 3, kCorners);
  const Scene scene = GltfScene(MeshJson(data, "\"attributes\":{\"POSITION\":0}"));
  CHECK(scene.triangle_count() == 1);
  CHECK(test::CountWarnings(scene, "the last 2 indices") == 1);
}

TEST_CASE("glTF: vertices that stand between others are read by their stride") {
  GltfData data;
  const size_t view = data.View<float>({0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 1, 0, 0, 0, 1},
                                       ",\"byteStride\":24");
  data.Accessor(view, GltfData::Members(5126, 3, "VEC3"));
  data.Accessor(view, "\"byteOffset\":12," + GltfData::Members(5126, 3, "VEC3"));
  const Scene scene = GltfScene(MeshJson(data, "\"attributes\":{\"POSITION\":0,\"NORMAL\":1}"));
  CHECK(Corners(scene) == std::vector<std::array<int, 3>>{{0, 10, 11}});
  CHECK(scene.normals == std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1});
}

TEST_CASE("glTF: quantised positions are whole numbers, or shares of the largest one") {
  GltfData data;
  const size_t view =
      data.View<int16_t>({0, 0, 0, 0, 32767, 0, 0, 0, 32767, -32768, 0, 0}, ",\"byteStride\":8");
  data.Accessor(view, GltfData::Members(5122, 3, "VEC3"));
  data.Accessor(view, "\"normalized\":true," + GltfData::Members(5122, 3, "VEC3"));
  const std::string used = "\"extensionsRequired\":[\"KHR_mesh_quantization\"],";
  const auto read = [&](const char* accessor) {
    return GltfScene(data.Json(used +
                               "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":" +
                               accessor + "}}]}]," + test::kOneNode))
        .positions;
  };
  CHECK(read("0") == std::vector<float>{0, 0, 0, 32767, 0, 0, 32767, -32768, 0});
  CHECK(read("1") == std::vector<float>{0, 0, 0, 1, 0, 0, 1, -1, 0});
}

TEST_CASE("glTF: texture coordinates of bytes and shorts are shares, stored with v upwards") {
  GltfData data;
  data.Floats("VEC3", 3, {0, 0, 0, 1, 0, 0, 1, 1, 0});
  const size_t bytes =
      data.View<uint8_t>({0, 255, 0, 0, 255, 255, 0, 0, 51, 0, 0, 0}, ",\"byteStride\":4");
  data.Accessor(bytes, "\"normalized\":true," + GltfData::Members(5121, 3, "VEC2"));
  const Scene scene = GltfScene(
      data.Json("\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1},"
                "\"material\":0}]}],\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":"
                "{\"index\":0}}}]," +
                test::kTextures + "," + test::kOneNode));
  REQUIRE(scene.uvs.size() == 6);
  CHECK(scene.uvs[0] == 0.0f);
  CHECK(scene.uvs[1] == 0.0f);
  CHECK(scene.uvs[2] == 1.0f);
  CHECK(scene.uvs[4] == doctest::Approx(0.2));
  CHECK(scene.uvs[5] == 1.0f);
}

TEST_CASE("glTF: a sparse accessor replaces rows, of data or of zeros") {
  GltfData data;
  data.Floats("VEC3", 3, kCorners);
  const size_t rows = data.View<uint16_t>({1, 2});
  const size_t values = data.View<float>({5, 0, 0, 5, 5, 0});
  const std::string sparse =
      ",\"sparse\":{\"count\":2,\"indices\":{\"bufferView\":" + std::to_string(rows) +
      ",\"componentType\":5123},\"values\":" + "{\"bufferView\":" + std::to_string(values) + "}}";
  data.Accessor(0, GltfData::Members(5126, 3, "VEC3") + sparse);
  data.accessors.push_back("{" + GltfData::Members(5126, 3, "VEC3") + sparse + "}");
  for (const char* accessor : {"1", "2"}) {
    const Scene scene =
        GltfScene(MeshJson(data, std::string("\"attributes\":{\"POSITION\":") + accessor + "}"));
    CHECK(Corners(scene) == std::vector<std::array<int, 3>>{{0, 50, 55}});
  }
}

TEST_CASE("glTF: of vertices that many primitives share, each takes only those between its own") {
  GltfData data;
  data.Floats("VEC3", 3, {9, 9, 9, 9, 9, 9, 0, 0, 0, 1, 0, 0, 1, 1, 0, 9, 9, 9});
  const size_t indices = data.Indices({2, 3, 4});
  const Scene scene = GltfScene(MeshJson(data, PositionsAnd(indices)));
  CHECK(scene.positions.size() == 9);
  CHECK(Corners(scene) == std::vector<std::array<int, 3>>{{0, 10, 11}});
}

TEST_CASE("glTF: a mesh without normals has none, and one with zero normals is told of") {
  GltfData data;
  data.Floats("VEC3", 3, {0, 0, 0, 1, 0, 0, 1, 1, 0});
  data.Floats("VEC3", 3, {0, 0, 0, 0, 0, 1, 0, 0, 1});
  const Scene plain = GltfScene(MeshJson(data, "\"attributes\":{\"POSITION\":0}"));
  CHECK(plain.normals.empty());
  CHECK(plain.shapes[0].record.normal_offset == kNone);
  const Scene zero = GltfScene(MeshJson(data, "\"attributes\":{\"POSITION\":0,\"NORMAL\":1}"));
  CHECK(zero.normals.empty());
  CHECK(test::CountWarnings(zero, "a normal is zero") == 1);
}

TEST_CASE("glTF: colours of vertices are kept, and vertices before them are white") {
  GltfData data;
  data.Floats("VEC3", 3, {0, 0, 0, 1, 0, 0, 1, 1, 0});
  data.Floats("VEC3", 3, {1, 0, 0, 0, 0.5f, 0, 0, 0, 0.25f});
  const Scene scene =
      GltfScene(data.Json("\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}},"
                          "{\"attributes\":{\"POSITION\":0,\"COLOR_0\":1}}]}]," +
                          test::kOneNode));
  REQUIRE(scene.colors.size() == 24);
  CHECK(scene.colors[11] == 1.0f);
  CHECK(scene.colors[12] == 1.0f);
  CHECK(scene.colors[13] == 0.0f);
  CHECK(scene.colors[17] == 0.5f);
  CHECK(scene.colors[23] == 1.0f);
  REQUIRE(scene.materials.size() == 2);
  CHECK(scene.materials[0].textures.empty());
  REQUIRE(scene.materials[1].textures.size() == 1);
  CHECK(scene.texture_nodes[scene.materials[1].textures[0].node].op == TextureOp::kVertexColor);
}

TEST_CASE("glTF: spans beyond their data are refused, each naming what reaches too far") {
  const auto check = [](const std::string& view, const std::string& accessor,
                        std::string_view fragment) {
    GltfData data;
    data.View(kCorners);
    data.views[0] = view;
    data.accessors.push_back(accessor);
    CheckGltfError(MeshJson(data, "\"attributes\":{\"POSITION\":0}"), fragment);
  };
  const std::string good_view = "{\"buffer\":0,\"byteLength\":60}";
  const std::string good = "{\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\",\"count\":";
  check(good_view, good + "6}", "beyond the 60 bytes of buffer view 0");
  check(good_view, good + "5,\"byteOffset\":4}", "beyond the 60 bytes");
  check(good_view, good + "5,\"byteOffset\":18446744073709551612}", "");
  check(good_view, good + "4294967295}", "elements");
  check(good_view, good + "18446744073709551615}", "");
  check("{\"buffer\":0,\"byteLength\":61}", good + "1}", "beyond the 60 bytes of buffer 0");
  check("{\"buffer\":0,\"byteOffset\":61,\"byteLength\":1}", good + "1}", "beyond the 60 bytes");
  check("{\"buffer\":7,\"byteLength\":1}", good + "1}", "no buffer 7");
  check("{\"buffer\":-1,\"byteLength\":1}", good + "1}", "no buffer");
  check("{\"buffer\":0,\"byteLength\":60,\"byteStride\":8}", good + "2}", "overlap");
  check(good_view, "{\"bufferView\":3,\"componentType\":5126,\"type\":\"VEC3\",\"count\":1}",
        "no buffer view 3");
  check(good_view, "{\"bufferView\":0,\"componentType\":5130,\"type\":\"VEC3\",\"count\":1}",
        "unknown type");
  check(good_view, "{\"bufferView\":0,\"componentType\":5126,\"type\":\"MAT4\",\"count\":0}",
        "unknown type");
  check(good_view, "{\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC2\",\"count\":3}",
        "3 components");
  check(good_view, "{\"componentType\":5126,\"type\":\"VEC3\",\"count\":700000000}",
        "without data");
}

TEST_CASE("glTF: indices and sparse rows beyond their vertices are refused") {
  GltfData data;
  data.Floats("VEC3", 3, {0, 0, 0, 1, 0, 0, 1, 1, 0});
  const size_t beyond = data.Indices({0, 1, 3});
  const size_t floats = data.Floats("SCALAR", 1, {0, 1, 2});
  CheckGltfError(MeshJson(data, PositionsAnd(beyond)), "index 3 at position 2");
  CheckGltfError(MeshJson(data, PositionsAnd(floats)), "no type that indices have");
  CheckGltfError(MeshJson(data, PositionsAnd(17)), "");
  CheckGltfError(MeshJson(data, "\"attributes\":{\"POSITION\":9}"), "accessor 9: is not there");
  GltfData sparse;
  sparse.Floats("VEC3", 3, kCorners);
  sparse.Accessor(0, GltfData::Members(5126, 3, "VEC3") +
                         ",\"sparse\":{\"count\":9,\"indices\":{\"bufferView\":0,"
                         "\"componentType\":5123},\"values\":{\"bufferView\":0}}");
  CheckGltfError(MeshJson(sparse, "\"attributes\":{\"POSITION\":1}"), "sparse");
}

TEST_CASE("glTF: attributes shorter than the positions are refused") {
  GltfData data;
  data.Floats("VEC3", 3, {0, 0, 0, 1, 0, 0, 1, 1, 0});
  data.Floats("VEC3", 3, {0, 0, 1, 0, 0, 1});
  CheckGltfError(MeshJson(data, "\"attributes\":{\"POSITION\":0,\"NORMAL\":1}"),
                 "has 2 elements where 3 are needed");
}

TEST_CASE("glTF: a vertex that is not finite is refused, as of other formats") {
  GltfData data;
  data.Floats("VEC3", 3, {0, 0, 0, 1, 0, 0, 1, std::numeric_limits<float>::quiet_NaN(), 0});
  CheckGltfError(MeshJson(data, "\"attributes\":{\"POSITION\":0}"), "vertex 2 is not finite");
}

}  // namespace swell
