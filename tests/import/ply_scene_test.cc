// Bare PLY files as scenes.
#include <doctest/doctest.h>

#include <string>

#include "src/import/import_scene.h"
#include "tests/support/temporary_folder.h"

namespace swell::test {
namespace {

std::string Ply(const std::string& vertices, const std::string& faces) {
  return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
         "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n" +
         vertices + faces;
}

TEST_CASE("ReadPlyScene: a mesh of clay with camera and light") {
  const TemporaryFolder folder;
  const std::string path = folder.Write("a.PLY", Ply("0 0 0\n1 0 0\n0 1 0\n", "3 0 1 2\n"));
  const Result<Scene> scene = ImportScene({path});
  REQUIRE(scene);
  CHECK(scene->triangle_count() == 1);
  CHECK(scene->shapes.size() == 1);
  CHECK(scene->prim_shape == std::vector<uint32_t>{0});
  REQUIRE(scene->materials.size() == 1);
  CHECK(std::string(kMaterialKinds[scene->materials[0].kind]->name) == "diffuse");
  CHECK(scene->lights.size() == 1);
  CHECK(scene->camera.camera_to_world[11] > 0.0f);
  CHECK(scene->warnings.empty());
}

TEST_CASE("ReadPlyScene: what cannot be a picture is an error that names the file") {
  const TemporaryFolder folder;
  const auto error = [&](const std::string& text) {
    const Result<Scene> scene = ImportScene({folder.Write("a.ply", text)});
    return scene ? "" : scene.error().message;
  };
  CHECK(error(Ply("0 0 0\n0 0 0\n0 1 0\n", "3 0 1 2\n")).find("without area") != std::string::npos);
  CHECK(error(Ply("0 0 0\n1 0 0\n0 nan 0\n", "3 0 1 2\n")).find("a.ply: vertex 2 is not finite") !=
        std::string::npos);
  CHECK(error("ply\nfoo\n").find("a.ply:") != std::string::npos);
  CHECK(error("obj") != "");
}

TEST_CASE("ImportScene: models are read alone, unknown endings are named with the known ones") {
  const TemporaryFolder folder;
  const std::string path = folder.Write("a.ply", Ply("0 0 0\n1 0 0\n0 1 0\n", "3 0 1 2\n"));
  CHECK(ImportScene({path, path}).error().message.find("give this one alone") != std::string::npos);
  const Result<Scene> unknown = ImportScene({folder.Write("a.stl", "solid")});
  CHECK(unknown.error().message.find("unknown scene format '.stl'; ") != std::string::npos);
  CHECK(unknown.error().message.find(".obj, .pbrt, .ply files are read") != std::string::npos);
}

}  // namespace
}  // namespace swell::test
