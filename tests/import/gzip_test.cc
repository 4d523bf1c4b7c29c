// Files packed by gzip: scenes, includes and meshes, and the ways in which such files lie.
#include <zlib.h>

#include "src/import/file_bytes.h"
#include "src/import/gunzip.h"
#include "src/import/ply.h"
#include "tests/import/scene_texts.h"

namespace swell {
namespace {

std::string Pack(std::string_view text) {
  z_stream stream{};
  REQUIRE(deflateInit2(&stream, 9, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY) == Z_OK);
  std::string packed(deflateBound(&stream, text.size()) + 64, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  REQUIRE(deflate(&stream, Z_FINISH) == Z_STREAM_END);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

constexpr std::string_view kTriangle =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
    "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

void CheckFails(const Result<std::string>& result, std::string_view text) {
  REQUIRE(!result);
  CAPTURE(result.error().message);
  CHECK(result.error().message.find(text) != std::string::npos);
}

}  // namespace

TEST_CASE("gzip: a packed scene, its packed include and its packed mesh read as plain ones do") {
  const test::TemporaryFolder folder;
  folder.Write("mesh.ply.gz", Pack(kTriangle));
  folder.Write("part.pbrt.gz", Pack("Shape \"plymesh\" \"string filename\" \"mesh.ply.gz\"\n"));
  const Result<Scene> scene = ImportScene({folder.Write(
      "scene.pbrt.gz",
      Pack("WorldBegin LightSource \"infinite\" Include \"part.pbrt.gz\" Shape \"sphere\""))});
  REQUIRE(scene);
  CHECK(scene->triangle_count() == 1);
  CHECK(scene->spheres.size() == 1);
  CHECK(scene->positions == std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0});
}

TEST_CASE("gzip: members that follow each other are one text; what is no member ends it") {
  const std::string two = Pack("one ") + Pack("two");
  CHECK(*Gunzip(two, 100) == "one two");
  CHECK(*Gunzip(two + "garbage", 100) == "one two");
}

TEST_CASE("gzip: large data come out whole, whatever size the trailer tells") {
  std::string text;
  for (int i = 0; i < 300000; ++i) text += std::to_string(i * int64_t{7919}) + " ";
  std::string packed = Pack(text);
  CHECK(*Gunzip(packed, text.size()) == text);
  CheckFails(Gunzip(packed, text.size() - 1), "unpacks to more than");
  for (size_t i = 1; i <= 4; ++i) packed[packed.size() - i] = '\xFF';  // the size, and no more
  CheckFails(Gunzip(packed, text.size()), "is damaged");
}

TEST_CASE("gzip: a bomb stops at the limit") {
  const std::string bomb = Pack(std::string(size_t{20} << 20, ' '));
  CHECK(bomb.size() < 30000);
  CheckFails(Gunzip(bomb, size_t{1} << 20), "unpacks to more than 1048576 bytes");
  const test::TemporaryFolder folder;
  const std::string path = folder.Write("bomb.gz", bomb);
  CHECK(!FileBytes::Read(path, size_t{1} << 20));
  CHECK(FileBytes::Read(path)->bytes().size() == size_t{20} << 20);
}

TEST_CASE("gzip: what is cut short or damaged is an error, wherever") {
  const std::string packed = Pack(kTriangle);
  for (size_t size = 2; size < packed.size(); ++size) {
    CAPTURE(size);
    CheckFails(Gunzip(std::string_view(packed).substr(0, size), 1000), "is cut short");
  }
  std::string wrong = packed;
  wrong[packed.size() - 6] ^= 1;  // the check sum
  CheckFails(Gunzip(wrong, 1000), "is damaged");
  const test::TemporaryFolder folder;
  const std::string path = folder.Write("mesh.ply.gz", packed.substr(0, packed.size() / 2));
  std::vector<float> positions, normals, uvs;
  std::vector<uint32_t> indices;
  const auto ply = ReadPly(path, {&positions, &normals, &uvs, &indices});
  REQUIRE(!ply);
  CHECK(ply.error().message == path + ": is cut short: its compressed data ends too early");
}

}  // namespace swell
