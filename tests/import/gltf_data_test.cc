// The models of the folder of real scenes (SWELL_DATA): each is read, with as many triangles as
// `assimp info FILE --raw` tells.
#include <cstdlib>
#include <filesystem>
#include <set>

#include "tests/import/gltf_texts.h"

#ifndef SWELL_DATA_FOLDER
#error "the folder of the real scenes"
#endif

namespace swell {
namespace {

struct Model {
  const char* path;    // below gltf/
  uint64_t triangles;  // of all meshes, each once
};

// "Faces" of assimp 5.2.5; of MeshPrimitiveModes those of its meshes of triangles.
constexpr Model kModels[] = {
    {"derived/TransmissionRoughnessTest-dispersion.glb", 77792},
    {"khronos/AlphaBlendModeTest/AlphaBlendModeTest.glb", 61},
    {"khronos/AnisotropyStrengthTest/AnisotropyStrengthTest.glb", 97240},
    {"khronos/AttenuationTest/AttenuationTest.glb", 232},
    {"khronos/Box/Box.glb", 12},
    {"khronos/BoxInterleaved/BoxInterleaved.glb", 12},
    {"khronos/Cameras/Cameras.gltf", 2},
    {"khronos/ClearCoatTest/ClearCoatTest.glb", 37116},
    {"khronos/EmissiveStrengthTest/EmissiveStrengthTest.glb", 90},
    {"khronos/GlassVaseFlowers/GlassVaseFlowers.glb", 10218},
    {"khronos/IridescenceSuzanne/IridescenceSuzanne.glb", 11808},
    {"khronos/LightsPunctualLamp/LightsPunctualLamp.gltf", 6000},
    {"khronos/MeshPrimitiveModes/MeshPrimitiveModes.gltf", 16},
    {"khronos/MetalRoughSpheresNoTextures/MetalRoughSpheresNoTextures.glb", 1040409},
    {"khronos/NormalTangentTest/NormalTangentTest.glb", 7774},
    {"khronos/SimpleSparseAccessor/SimpleSparseAccessor.gltf", 12},
    {"khronos/SpecularTest/SpecularTest.glb", 44828},
    {"khronos/TextureCoordinateTest/TextureCoordinateTest.glb", 10},
    {"khronos/TextureSettingsTest/TextureSettingsTest.glb", 72},
    {"khronos/ToyCar/ToyCar.gltf", 108936},
    {"khronos/TransmissionRoughnessTest/TransmissionRoughnessTest.glb", 77792},
    {"khronos/TransmissionTest/TransmissionTest.glb", 128775},
    {"khronos/Triangle/Triangle.gltf", 1},
    {"khronos/TriangleWithoutIndices/TriangleWithoutIndices.gltf", 1},
    {"wooden-staircase/wooden-staircase.gltf", 262663},
};

// Triangles without area are in the file but not in the scene.
uint64_t DroppedTriangles(const Scene& scene) {
  uint64_t dropped = 0;
  for (const std::string& warning : scene.warnings) {
    const size_t end = warning.find(" triangles without area");
    if (end == std::string::npos) continue;
    const size_t space = warning.rfind(' ', end - 1);
    dropped += std::strtoull(warning.c_str() + space + 1, nullptr, 10);
  }
  return dropped;
}

}  // namespace

TEST_CASE("glTF: every model of the data is read, with the triangles that assimp counts") {
  for (const Model& model : kModels) {
    CAPTURE(model.path);
    const Result<Scene> scene =
        ImportScene({std::string(SWELL_DATA_FOLDER) + "/gltf/" + model.path});
    INFO((scene ? "" : scene.error().message));
    REQUIRE(scene);
    CHECK(scene->triangle_count() + DroppedTriangles(*scene) == model.triangles);
  }
}

TEST_CASE("glTF: the table names every model of the data") {
  const std::filesystem::path root = std::filesystem::path(SWELL_DATA_FOLDER) / "gltf";
  std::set<std::string> known, found;
  for (const Model& model : kModels) known.insert(model.path);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    const std::string ending = entry.path().extension();
    if (ending == ".gltf" || ending == ".glb") {
      found.insert(std::filesystem::relative(entry.path(), root));
    }
  }
  CHECK(found == known);
}

TEST_CASE("glTF: the malformed samples of the data are refused") {
  const std::filesystem::path root = std::filesystem::path(SWELL_DATA_FOLDER) / "malformed-samples";
  size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(root)) {
    const std::string ending = entry.path().extension();
    if (ending != ".gltf" && ending != ".glb") continue;
    ++files;
    CAPTURE(entry.path().string());
    CHECK_FALSE(ImportScene({entry.path()}));
  }
  CHECK(files > 0);
}

}  // namespace swell
