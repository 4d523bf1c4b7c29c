// OBJ files as scenes: faces, indices, groups, warnings and errors.
#include "src/import/obj.h"

#include <doctest/doctest.h>

#include <string>

#include "src/import/import_scene.h"
#include "tests/import/scene_texts.h"
#include "tests/support/temporary_folder.h"

namespace swell::test {
namespace {

const std::string kCorners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

Result<Scene> ReadObjText(std::string_view text) {
  const TemporaryFolder folder;
  return ImportScene({folder.Write("m.obj", text)});
}

Scene ObjOf(std::string_view text) {
  Result<Scene> scene = ReadObjText(text);
  INFO(text);
  INFO((scene ? "" : scene.error().message));
  REQUIRE(scene);
  return std::move(*scene);
}

std::string ErrorOf(std::string_view text) {
  const Result<Scene> scene = ReadObjText(text);
  return scene ? "" : scene.error().message;
}

TEST_CASE("ReadObj: quads are two triangles, with rows from the end and rows to come") {
  for (const std::string& text : {kCorners + "f 1 2 3 4", kCorners + "f -4 -3 -2 -1\n",
                                  "f 1 2 3 4\n" + kCorners, kCorners + "f 1 2 \\\n 3 4 # four"}) {
    const Scene scene = ObjOf(text);
    CHECK(scene.indices == std::vector<uint32_t>{0, 1, 2, 0, 2, 3});
    CHECK(scene.positions == std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    CHECK(scene.normals.empty());
    CHECK(scene.uvs.empty());
    CHECK(scene.shapes.size() == 1);
    CHECK(scene.warnings.empty());
    CHECK(scene.lights.size() == 1);
  }
}

TEST_CASE("ReadObj: corners that differ in any row are vertices of their own") {
  const Scene scene = ObjOf(kCorners +
                            "vt 0 0\nvt 1 0.5\nvn 0 0 2\nvn 0 1 0\n"
                            "f 1/1/1 2/2/1 3/1/1\nf 1/1/1 3/1/1 4/1/1\nf 1/2/1 3/1/2 4/1/1\n");
  CHECK(scene.triangle_count() == 3);
  CHECK(scene.positions.size() / 3 == 6);
  CHECK(scene.uvs.size() / 2 == 6);
  CHECK(scene.normals.size() / 3 == 6);
  CHECK(scene.indices == std::vector<uint32_t>{0, 1, 2, 0, 2, 3, 4, 5, 3});
  CHECK(scene.uvs[2] == 1.0f);
  CHECK(scene.uvs[3] == 0.5f);
  CHECK(scene.normals[2] == 1.0f);  // unit
}

TEST_CASE("ReadObj: faces with and without uv or normals are meshes apart") {
  const Scene scene = ObjOf(kCorners +
                            "vt 0 0\nvn 0 0 1\nf 1 2 3\nf 1/1 2/1 3/1\nf 1//1 2//1 3//1\n"
                            "f 1/1/1 2/1/1 3/1/1\nf 1/1 2 3/1\nf 1// 2/ 4//\n");
  REQUIRE(scene.shapes.size() == 4);
  CHECK(scene.triangle_count() == 6);
  CHECK(scene.shapes[0].record.prim_count == 3);
  CHECK(scene.shapes[0].record.uv_offset == kNone);
  CHECK(scene.shapes[0].record.normal_offset == kNone);
  CHECK(scene.shapes[1].record.uv_offset != kNone);
  CHECK(scene.shapes[2].record.normal_offset != kNone);
  CHECK(scene.shapes[3].record.uv_offset != kNone);
}

TEST_CASE("ReadObj: many corners at one point stay quick") {
  std::string text = kCorners + "vn 0 0 1\n";
  constexpr int kFaces = 20000;
  for (int i = 0; i < kFaces; ++i) {
    text += "vt " + std::to_string(i) + " 0\nf 1/" + std::to_string(i + 1) + "/1 2/1/1 3/1/1\n";
  }
  const Scene scene = ObjOf(text);
  CHECK(scene.triangle_count() == kFaces);
  CHECK(scene.positions.size() / 3 == kFaces + 2);
}

TEST_CASE("ReadObj: a weight divides, colours are left out with a warning") {
  const Scene scene = ObjOf("v 0 0 0\nv 2 0 0 2\nv 0 1 0 1 0 0\nf 1 2 3\n");
  CHECK(scene.positions == std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0});
  CHECK(Warns(scene, "m.obj:3: colours of vertices are not supported"));
}

TEST_CASE("ReadObj: what is no surface is left out with a warning") {
  const Scene scene =
      ObjOf(kCorners +
            "o a\ng b c\ns 1\nf 1 2 3\nl 1 2\np 1\np 2\nf 1 2\ncurv 0 1 1 2\n"
            "foo 1\ncall other.obj\nv 3.1+e2 0 0\nmtllib\nmtllib none.mtl\nf 1 1 2\n");
  CHECK(scene.triangle_count() == 1);
  CHECK(Warns(scene, "m.obj:9: points and lines are left out (and 2 more like it)"));
  CHECK(Warns(scene, "m.obj:12: faces of fewer than 3 corners are left out"));
  CHECK(Warns(scene, "free-form curves and surfaces are not supported"));
  CHECK(Warns(scene, "m.obj:14: unknown statement 'foo' is ignored"));
  CHECK(Warns(scene, "'call' is not obeyed"));
  CHECK(Warns(scene, "what follows in '3.1+e2' is ignored"));
  CHECK(Warns(scene, "m.obj:18: the material file 'none.mtl' does not exist"));
  CHECK(Warns(scene, "1 triangles without area are left out"));
  CHECK(scene.warnings.size() == 9);
}

TEST_CASE("ReadObj: errors name file, line and what would be right") {
  const struct {
    std::string text;
    const char* error;
  } kRows[] = {
      {"", "m.obj: is empty"},
      {"# nothing\n", "m.obj: has no faces"},
      {kCorners + "p 1\n", "m.obj: has no faces"},
      {"v 0 0\n", "m.obj:1: a vertex needs 3 numbers, not 2"},
      {"v 0 0 nan\n", "m.obj:1: a vertex has 'nan', which is no finite number"},
      {"\nv 0 -inf 0\n", "m.obj:2: a vertex has '-inf'"},
      {"v 0 1e99 0\n", "m.obj:1: the vertex lies beyond the range of numbers"},
      {"v 0 x 0\n", "m.obj:1: a vertex has 'x'"},
      {"vn 0 1\n", "m.obj:1: a normal needs 3 numbers, not 2"},
      {"vt\n", "m.obj:1: a texture coordinate needs 1 numbers, not 0"},
      {kCorners + "f 1 2 5\n", "m.obj:5: a face names vertex 5, but the file has 4"},
      {kCorners + "f 1 2 9\nf 1 2 7\n", "m.obj:5: a face names vertex 9"},
      {kCorners + "f 0 1 2\n", "m.obj:5: a face's corner '0' names a vertex that is not there"},
      {kCorners + "f -5 1 2\n", "m.obj:5: a face's corner '-5' names a vertex that is not there"},
      {kCorners + "f 99999999999 1 2\n", "'99999999999' names a vertex that is not there"},
      {kCorners + "f 9223372036854775809 1 2\n", "a face's corner is written 1, 1/1, 1//1"},
      {kCorners + "f 1 2 a\n", "a face's corner is written 1, 1/1, 1//1 or 1/1/1, not 'a'"},
      {kCorners + "f 1/2/3/4 2 3\n", "not '1/2/3/4'"},
      {kCorners + "f /1 2 3\n", "not '/1'"},
      {kCorners + "f 1 1 2\n", "m.obj: all its faces are without area"},
      {"v 0 0 0\nv 1e30 0 0\nv 0 1e30 0\nf 1 2 3\nv 3 \\\n", "m.obj:5: a vertex needs 3 numbers"},
  };
  for (const auto& row : kRows) {
    const std::string error = ErrorOf(row.text);
    INFO(row.text);
    INFO("expected: ", std::string(row.error), "\ngot: ", error);
    CHECK(error.find(row.error) != std::string::npos);
  }
}

TEST_CASE("ReadObj: uvs and normals that are not there are done without") {
  const Scene scene = ObjOf(
      kCorners + "vt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\nf 1/1/1 3/1/1 4/1/2\nf 1/2 2/2 3/2\n");
  REQUIRE(scene.shapes.size() == 2);
  CHECK(scene.shapes[0].record.uv_offset != kNone);
  CHECK(scene.shapes[0].record.normal_offset == kNone);
  CHECK(scene.shapes[1].record.uv_offset == kNone);
  CHECK(Warns(scene, "m.obj:7: faces name normals that the file does not have"));
  CHECK(Warns(scene, "m.obj:9: faces name texture coordinates that the file does not have"));
}

TEST_CASE("ReadObj: every truncation of a good file is a scene or an error") {
  const std::string good = kCorners + "vt 0 0\nvn 0 0 1\nusemtl a\nf 1/1/1 2/1/1 3/1/1 4/1/1\n";
  CHECK(ErrorOf(good) == "");
  for (size_t size = 0; size < good.size() - 20; ++size) {
    INFO(size);
    CHECK(ErrorOf(good.substr(0, size)) != "");
  }
}

TEST_CASE("ReadObj: UTF-16 and odd line ends are read") {
  std::string wide = "\xFF\xFE";
  for (const char c : kCorners + "f 1 2 3\r") wide += {c, '\0'};
  CHECK(ObjOf(wide).triangle_count() == 1);
}

}  // namespace
}  // namespace swell::test
