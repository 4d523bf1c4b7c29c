// glTF files as such: containers, buffers and images by all ways, and what is refused.
#include <cstdint>
#include <string>

#include "src/scene/image.h"
#include "tests/import/gltf_texts.h"
#include "tests/support/error_lines.h"

namespace swell {
namespace {

using test::CheckGltfError;
using test::CheckRefused;
using test::GltfData;

std::string Word(uint32_t value) {
  std::string bytes;
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>(value >> 8 * i & 0xFF);
  return bytes;
}

std::string Chunk(uint32_t type, std::string bytes) {
  bytes.resize((bytes.size() + 3) / 4 * 4, ' ');
  return Word(static_cast<uint32_t>(bytes.size())) + Word(type) + bytes;
}
constexpr uint32_t kJson = 0x4E4F534A, kBinary = 0x004E4942;

std::string Glb(const std::string& chunks) {
  return "glTF" + Word(2) + Word(static_cast<uint32_t>(12 + chunks.size())) + chunks;
}

Result<Scene> ReadGlb(const std::string& bytes) {
  const test::TemporaryFolder folder;
  return ImportScene({folder.Write("scene.glb", bytes)});
}

const std::string kTriangleMesh =
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}]," + test::kOneNode;

GltfData Triangle() {
  GltfData data;
  data.Floats("VEC3", 3, {0, 0, 0, 1, 0, 0, 0, 1, 0});
  return data;
}

std::string GoodGlb() {
  const GltfData data = Triangle();
  return Glb(Chunk(kJson, data.Json(kTriangleMesh, "none")) + Chunk(kBinary, data.bytes));
}

}  // namespace

TEST_CASE("glTF: a .glb file holds its first buffer in itself") {
  const Result<Scene> scene = ReadGlb(GoodGlb());
  INFO((scene ? "" : scene.error().message));
  REQUIRE(scene);
  CHECK(scene->triangle_count() == 1);
  CHECK(scene->positions[3] == 1.0f);
}

TEST_CASE("glTF: a .glb file is refused wherever it is cut off") {
  const std::string whole = GoodGlb();
  const test::TemporaryFolder folder;
  for (size_t size = 1; size < whole.size(); ++size) {
    const std::string path = folder.Write("cut.glb", whole.substr(0, size));
    const Result<Scene> scene = ImportScene({path});
    REQUIRE_FALSE(scene);
    test::CheckIsLineAbout(scene.error(), path);
  }
}

TEST_CASE("glTF: chunks that lie about themselves are refused") {
  const GltfData data = Triangle();
  const std::string json = Chunk(kJson, data.Json(kTriangleMesh, "none"));
  CheckRefused(ReadGlb(Glb(Chunk(kBinary, data.bytes) + json)), "begin with a chunk of JSON");
  // A binary chunk whose length reaches 8 bytes beyond the file.
  std::string longer = Chunk(kBinary, data.bytes);
  longer[0] = static_cast<char>(longer[0] + 8);
  CheckRefused(ReadGlb(Glb(json + longer)), "ends beyond the file");
  CheckRefused(ReadGlb(Glb(json)), "neither a \"uri\" nor a binary chunk");
  CheckRefused(ReadGlb("glTF" + Word(1) + GoodGlb().substr(8)), "version 1");
  CheckRefused(ReadGlb(Glb(json + Chunk(kBinary, data.bytes.substr(0, 8)))), "has 8 bytes of 36");
}

TEST_CASE("glTF: buffers are read from files, by names with percents, and from data URIs") {
  const GltfData data = Triangle();
  const test::TemporaryFolder folder;
  const std::string name = folder.Write("parts/the data.bin", data.bytes);
  for (const std::string& uri : {std::string("parts/the%20data.bin"), name, "file://" + name}) {
    const Result<Scene> scene =
        ImportScene({folder.Write("scene.gltf", data.Json(kTriangleMesh, uri))});
    INFO((scene ? "" : scene.error().message));
    REQUIRE(scene);
    CHECK(scene->triangle_count() == 1);
  }
  CHECK(test::GltfScene(data.Json(kTriangleMesh)).triangle_count() == 1);
  CheckGltfError(data.Json(kTriangleMesh, "gone.bin"), "gone.bin: does not exist");
  CheckGltfError(data.Json(kTriangleMesh, "http://example.org/a.bin"), "is not a file");
  CheckGltfError(data.Json(kTriangleMesh, "data:,"), "has 0 bytes of 36");
  CheckGltfError(data.Json(kTriangleMesh, "data:a;base64,A?B="), "not base64");
  CheckGltfError(data.Json(kTriangleMesh, "data:a;base64"), "has no ','");
}

TEST_CASE("glTF: JSON that is none, too deep, or of another version is refused") {
  CheckGltfError("no json", "is not JSON");
  CheckGltfError("[1]", "is not an object");
  CheckGltfError("{}", "version ''");
  CheckGltfError(R"({"asset":{"version":"1.0"}})", "version '1.0'; version 2.0 is read");
  CheckGltfError(R"({"asset":{"version":"2.0"},"extras":)" + std::string(200, '[') +
                     std::string(200, ']') + "}",
                 "nested more than 128 deep");
  CheckGltfError(R"({"asset":{"version":"2.0"},"buffers":{}})", "\"buffers\" is not a list");
  CheckGltfError(R"({"asset":{"version":"2.0"},"images":[3]})", "images 0 is not an object");
  CheckGltfError(R"({"asset":{"version":"2.0"},"nodes":[3]})", "is not valid glTF");
}

TEST_CASE("glTF: a required extension that is unknown is refused, another one is told of") {
  CheckGltfError(R"({"asset":{"version":"2.0"},"extensionsRequired":["KHR_texture_basisu"]})",
                 "requires the extension 'KHR_texture_basisu', which is not supported; export");
  const Scene scene = test::GltfScene(
      R"({"asset":{"version":"2.0"},"extensionsUsed":["ACME_x","KHR_xmp","KHR_materials_ior"]})");
  CHECK(scene.warnings.size() == 1);
  CHECK(test::CountWarnings(scene, "'ACME_x'") == 1);
}

TEST_CASE("glTF: images come from data URIs, buffer views and files") {
  std::string png;
  {  // the same bytes as kPng
    const std::string text = test::kPng;
    uint32_t bits = 0;
    int count = 0;
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (char c : text) {
      if (c == '=') break;
      bits = bits << 6 | static_cast<uint32_t>(digits.find(c));
      count += 6;
      if (count < 8) continue;
      count -= 8;
      png += static_cast<char>(bits >> count & 0xFF);
    }
  }
  GltfData data = test::SquareData();
  const size_t view = data.View(std::vector<char>(png.begin(), png.end()));
  const test::TemporaryFolder folder;
  folder.Write("my image.png", png);
  const std::string material =
      "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}}],"
      "\"textures\":[{\"source\":0}],\"meshes\":[{" +
      test::kSquare + "}]," + test::kOneNode + ",\"images\":[{";
  for (const std::string& source :
       {std::string("\"uri\":\"data:image/png;base64,") + test::kPng + "\"",
        std::string("\"uri\":\"my%20image.png\""),
        "\"mimeType\":\"image/png\",\"bufferView\":" + std::to_string(view)}) {
    const Result<Scene> scene =
        ImportScene({folder.Write("scene.gltf", data.Json(material + source + "}]"))});
    INFO((scene ? "" : scene.error().message));
    REQUIRE(scene);
    REQUIRE(scene->images.size() == 1);
    CHECK(TexelAt(scene->images[0], 0, 0, 0) == std::array<float, 3>{1, 0, 0});
    CHECK(TexelAt(scene->images[0], 0, 0, 1) == std::array<float, 3>{0, 0, 1});
  }
  CheckGltfError(data.Json(material + "\"uri\":\"gone.png\"}]"), "gone.png");
  CheckGltfError(data.Json(material + "\"bufferView\":99}]"), "no buffer view 99");
  CheckGltfError(data.Json(material + "\"bufferView\":0}]"), "neither PNG nor JPEG");
}

}  // namespace swell
