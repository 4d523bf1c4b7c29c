// The PLY reader in all encodings and layouts, and the ways files lie.
#include "src/import/ply.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "tests/import/scene_texts.h"

namespace swell {
namespace {

struct Mesh {
  std::vector<float> positions, normals, uvs;
  std::vector<uint32_t> indices;
  PlyContents contents;
  std::string error;
};

Mesh Read(std::string_view bytes, size_t rows_before = 0) {
  const test::TemporaryFolder folder;
  Mesh mesh;
  mesh.positions.resize(3 * rows_before);
  const auto contents = ReadPly(folder.Write("m.ply", bytes),
                                {&mesh.positions, &mesh.normals, &mesh.uvs, &mesh.indices});
  if (contents) {
    mesh.contents = *contents;
  } else {
    mesh.error = contents.error().message;
  }
  return mesh;
}

// Values as the bytes of a binary file.
class Bytes {
 public:
  explicit Bytes(bool big_endian) : big_endian_(big_endian) {}
  template <class T> Bytes& Add(std::initializer_list<T> values) {
    for (T value : values) {
      char bytes[sizeof(T)];
      std::memcpy(bytes, &value, sizeof(T));
      if (big_endian_) std::reverse(bytes, bytes + sizeof(T));
      text_.append(bytes, sizeof(T));
    }
    return *this;
  }
  const std::string& text() const { return text_; }

 private:
  bool big_endian_;
  std::string text_;
};

std::string BinaryHeader(bool big_endian, const std::string& elements) {
  return std::string("ply\nformat ") + (big_endian ? "binary_big_endian" : "binary_little_endian") +
         " 1.0\n" + elements + "end_header\n";
}

const std::string kXyz = "property float x\nproperty float y\nproperty float z\n";
const std::string kList = "property list uchar int vertex_indices\n";

const std::vector<float> kSquare = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};

}  // namespace

TEST_CASE("ReadPly: ASCII with comments, extra properties, uneven space and quads") {
  const Mesh mesh = Read(
      "ply\r\nformat ascii 1.0\r\ncomment by hand\r\nelement vertex 4\r\n"
      "property double x\r\nproperty float quality\r\nproperty float y\r\nproperty float z\r\n"
      "element face 2\r\nproperty uchar flag\r\nproperty list uchar uint vertex_index\r\n"
      "element edge 1\r\nproperty int a\r\nproperty list int float b\r\nend_header\r\n"
      "0 9 0 0\r\n1 9 0 0\r\n  1\t9 1 0\r\n0 9 1 0\r\n7 4 0 1 2 3\r\n7 3 0 1 2\r\n5 2 1 1\r\n");
  CHECK(mesh.error == "");
  CHECK(mesh.positions == kSquare);
  CHECK(mesh.indices == std::vector<uint32_t>{0, 1, 2, 0, 2, 3, 0, 1, 2});
  CHECK(mesh.contents.triangles == 3);
  CHECK(!mesh.contents.has_normals);
}

TEST_CASE("ReadPly: both binary orders give the same mesh, with normals and uvs") {
  for (bool big_endian : {false, true}) {
    INFO(big_endian);
    Bytes body(big_endian);
    for (size_t i = 0; i < 4; ++i) {
      body.Add<float>({kSquare[3 * i], kSquare[3 * i + 1], kSquare[3 * i + 2], 0, 0, 1, 0.25f,
                       static_cast<float>(i)});
    }
    body.Add<uint8_t>({3}).Add<int32_t>({0, 1, 2}).Add<uint8_t>({4}).Add<int32_t>({0, 1, 2, 3});
    const Mesh mesh = Read(
        BinaryHeader(big_endian, "element vertex 4\n" + kXyz +
                                     "property float nx\nproperty float ny\nproperty float nz\n"
                                     "property float s\nproperty float t\nelement face 2\n" +
                                     kList) +
            body.text(),
        5);
    CHECK(mesh.error == "");
    CHECK(std::vector<float>(mesh.positions.begin() + 15, mesh.positions.end()) == kSquare);
    CHECK(mesh.indices == std::vector<uint32_t>{5, 6, 7, 5, 6, 7, 5, 7, 8});
    CHECK(mesh.contents.has_normals);
    CHECK(mesh.normals.size() == 12);
    CHECK(mesh.normals[11] == 1.0f);
    CHECK(mesh.uvs == std::vector<float>{0.25f, 0, 0.25f, 1, 0.25f, 2, 0.25f, 3});
  }
}

TEST_CASE("ReadPly: every scalar type and lists among the vertices' properties") {
  for (bool big_endian : {false, true}) {
    Bytes body(big_endian);
    const auto vertex = [&](double x, int16_t y, int8_t z) {
      body.Add<double>({x}).Add<uint8_t>({2}).Add<uint16_t>({1, 2}).Add<int16_t>({y}).Add<int8_t>(
          {z});
    };
    vertex(-1.5, -300, -7);
    vertex(2, 5, 6);
    vertex(3, 4, 5);
    body.Add<uint16_t>({3}).Add<uint16_t>({2, 1, 0});
    const Mesh mesh =
        Read(BinaryHeader(big_endian,
                          "element vertex 3\nproperty float64 x\nproperty list uint8 uint16 l\n"
                          "property int16 y\nproperty int8 z\nelement face 1\n"
                          "property list ushort ushort vertex_indices\n") +
             body.text());
    CHECK(mesh.error == "");
    CHECK(mesh.positions == std::vector<float>{-1.5f, -300, -7, 2, 5, 6, 3, 4, 5});
    CHECK(mesh.indices == std::vector<uint32_t>{2, 1, 0});
  }
}

TEST_CASE("ReadPly: faces of many vertices are fans, of fewer than three left out") {
  const Mesh mesh = Read("ply\nformat ascii 1.0\nelement vertex 5\n" + kXyz + "element face 3\n" +
                         kList + "end_header\n0 0 0 1 0 0 1 1 0 0 1 0 0 2 0\n5 0 1 2 3 4 2 0 1 0");
  CHECK(mesh.error == "");
  CHECK(mesh.indices == std::vector<uint32_t>{0, 1, 2, 0, 2, 3, 0, 3, 4});
  CHECK(mesh.contents.short_faces == 2);
}

TEST_CASE("ReadPly: bad files end in an error that names the place") {
  const std::string ascii = "ply\nformat ascii 1.0\n";
  const std::string vertices = "element vertex 3\n" + kXyz;
  const std::string faces = "element face 1\n" + kList + "end_header\n";
  const std::string three = "0 0 0\n1 0 0\n0 1 0\n";
  Bytes floats(false), truncated(false), outside(false), nan(false);
  floats.Add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0});
  truncated.Add<uint8_t>({3}).Add<int32_t>({0, 1});
  outside.Add<uint8_t>({3}).Add<int32_t>({0, 1, -1});
  nan.Add<float>({0, 0, 0, 1, std::nanf(""), 0, 0, 1, 0}).Add<uint8_t>({3}).Add<int32_t>({0, 1, 2});
  const std::string binary = BinaryHeader(false, vertices + "element face 1\n" + kList);
  const struct {
    std::string bytes;
    const char* error;
  } kRows[] = {
      {"hello", "is no PLY file"},
      {"", "is empty"},
      {"ply\n", "no 'end_header'"},
      {"ply\nformat ascii 1.0\n" + vertices, "no 'end_header'"},
      {"ply\nformat binary 1.0\n", ":2: unknown format 'binary'"},
      {"ply\n" + vertices + faces + three, "'format' is missing"},
      {ascii + "elemnt vertex 3\n", ":3: unknown header line 'elemnt'; did you mean 'element'?"},
      {ascii + "element vertex three\n", ":3: 'element NAME COUNT' is expected"},
      {ascii + "element vertex -3\n", ":3: 'element NAME COUNT' is expected"},
      {ascii + "property float x\n", ":3: a property comes before"},
      {ascii + "element vertex 3\nproperty flaot x\n", ":4: unknown property type 'flaot'"},
      {ascii + "element face 1\nproperty list float int vertex_indices\n", ":4: the count"},
      {ascii + "element vertex 3\nelement vertex 3\n", "given twice"},
      {ascii + "element vertex 3\nproperty float x\nproperty float y\n" + faces + three,
       ":3: vertices have no x, y and z"},
      {ascii + vertices + "end_header\n" + three, "has no element 'face'"},
      {ascii + faces + "3 0 1 2", "has no element 'vertex'"},
      {ascii + "element face 1\n" + kList + vertices + "end_header\n3 0 1 2\n" + three,
       "faces come before their vertices"},
      {ascii + vertices + "element face 1\nproperty int a\nend_header\n" + three + "1",
       "faces have no list"},
      {ascii + vertices + faces + three + "3 0 1", "ends or has no number in face 0 of 1"},
      {ascii + vertices + faces + "0 0 0 1 0 0 x 1 0\n3 0 1 2", "in vertex 2 of 3 at line"},
      {ascii + vertices + faces + "0 0 0\n1 0 nan\n0 1 0\n3 0 1 2",
       "vertex 1 is not finite at line 11"},
      {ascii + vertices + faces + "0 0 0\n1 0 1e60\n0 1 0\n3 0 1 2", "vertex 1 is not finite"},
      {ascii + vertices + faces + three + "3 0 1 3", "face 0 has a vertex index outside of 0 to 2"},
      {ascii + vertices + faces + three + "3 0 1 -1", "face 0 has a vertex index outside"},
      {ascii + "element vertex 99999999999\n" + kXyz + faces + three + "3 0 1 2",
       ":3: 99999999999 vertex rows do not fit"},
      {ascii + vertices + "element face 4000000000\n" + kList + "end_header\n" + three + "3 0 1 2",
       "4000000000 face rows do not fit"},
      {binary + floats.text(), "face rows do not fit the 0 bytes left"},
      {binary + floats.text().substr(0, 35), "vertex rows do not fit the 35 bytes"},
      {binary + floats.text() + truncated.text(), "in face 0 of 1 at byte"},
      {binary + floats.text() + outside.text(), "face 0 has a vertex index outside of 0 to 2"},
      {binary + nan.text(), "vertex 1 is not finite at byte"},
      {binary + floats.text() + "\xFF", "impossible number of vertices"},
      {ascii + vertices + "element tristrips 1\n" + kList + faces + three, "'tristrips'"},
  };
  for (const auto& row : kRows) {
    const Mesh mesh = Read(row.bytes);
    INFO(row.bytes);
    INFO("expected: ", std::string(row.error), "\ngot: ", mesh.error);
    CHECK(mesh.error.find(row.error) != std::string::npos);
    CHECK(mesh.error.find("m.ply") != std::string::npos);
    CHECK(mesh.positions.capacity() < 1000);
    CHECK(mesh.indices.capacity() < 1000);
  }
}

TEST_CASE("ReadPly: every truncation of a good file is an error, not a crash") {
  Bytes body(false);
  body.Add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}).Add<uint8_t>({3}).Add<int32_t>({0, 1, 2});
  const std::string good =
      BinaryHeader(false, "element vertex 3\n" + kXyz + "element face 1\n" + kList) + body.text();
  CHECK(Read(good).error == "");
  for (size_t size = 0; size < good.size(); ++size) {
    INFO(size);
    CHECK(Read(good.substr(0, size)).error != "");
  }
}

}  // namespace swell
