// glTF nodes: transforms, hierarchy, meshes placed once or often, lights and cameras.
#include <array>
#include <cmath>

#include "tests/import/gltf_texts.h"

namespace swell {
namespace {

using test::CheckGltfError;
using test::GltfData;
using test::GltfScene;
using Float3 = std::array<float, 3>;

GltfData Triangle() {
  GltfData data;
  data.Floats("VEC3", 3, {0, 0, 0, 1, 0, 0, 0, 1, 0});
  return data;
}
const std::string kMesh = "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],";

Scene NodesOf(const std::string& nodes) {
  return GltfScene(Triangle().Json(kMesh + "\"nodes\":[" + nodes + "]"));
}
void CheckNodesError(const std::string& nodes, std::string_view fragment) {
  CheckGltfError(Triangle().Json(kMesh + "\"nodes\":[" + nodes + "]"), fragment);
}

void CheckCorner(const Scene& scene, size_t corner, const Float3& expected) {
  for (size_t c = 0; c < 3; ++c) {
    CHECK(scene.positions[3 * scene.indices[corner] + c] ==
          doctest::Approx(expected[c]).epsilon(1e-5));
  }
}

Float3 Origin(const InstanceRecord& instance) {
  return {instance.centre[0], instance.centre[1], instance.centre[2]};
}

}  // namespace

TEST_CASE("glTF: a node scales, then turns, then moves; parents come after children") {
  const Scene scene = NodesOf(
      R"({"translation":[10,0,0],"children":[1]},
         {"mesh":0,"translation":[0,1,0],"rotation":[0,0,0.70710678,0.70710678],"scale":[2,3,4]})");
  CheckCorner(scene, 0, {10, 1, 0});
  CheckCorner(scene, 1, {10, 3, 0});  // x, twice as long, turned to y
  CheckCorner(scene, 2, {7, 1, 0});
}

TEST_CASE("glTF: a node's matrix stands by columns") {
  const Scene scene = NodesOf(R"({"mesh":0,"matrix":[0,1,0,0, 0,0,1,0, 1,0,0,0, 5,6,7,1]})");
  CheckCorner(scene, 0, {5, 6, 7});
  CheckCorner(scene, 1, {5, 7, 7});
  CheckCorner(scene, 2, {5, 6, 8});
}

TEST_CASE("glTF: a mesh of one node stands in the world, of several it is an object") {
  const Scene once = NodesOf(R"({"mesh":0,"translation":[1,2,3]})");
  CHECK(once.objects.empty());
  CHECK(once.instances.empty());
  const Scene twice = NodesOf(R"({"mesh":0,"translation":[1,2,3]},{"mesh":0,"scale":[-1,2,2]})");
  REQUIRE(twice.objects.size() == 1);
  CHECK(twice.triangle_count() == 1);
  CHECK(twice.objects[0].triangle_count == 1);
  REQUIRE(twice.instances.size() == 2);
  CHECK(Origin(twice.instances[0]) == Float3{1, 2, 3});
  CHECK(twice.instances[1].to_world[0] == -1.0f);
  CheckCorner(twice, 1, {1, 0, 0});
}

TEST_CASE("glTF: of a mesh placed often, only what emits stands in the world each time") {
  const std::string json = Triangle().Json(
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0},
                                  {"attributes":{"POSITION":0}}]}],
         "materials":[{"emissiveFactor":[1,1,1]}],
         "nodes":[{"mesh":0,"translation":[5,0,0]},{"mesh":0,"translation":[6,0,0]}])");
  const Scene scene = GltfScene(json);
  REQUIRE(scene.objects.size() == 1);
  CHECK(scene.objects[0].triangle_count == 1);
  CHECK(scene.instances.size() == 2);
  REQUIRE(scene.shapes.size() == 3);
  CHECK_FALSE(scene.shapes[0].emits);
  CHECK(scene.shapes[1].emits);
  CHECK(scene.shapes[2].emits);
  CheckCorner(scene, 3, {5, 0, 0});
  CheckCorner(scene, 6, {6, 0, 0});
}

TEST_CASE("glTF: EXT_mesh_gpu_instancing places instances in the node's space") {
  GltfData data = Triangle();
  const size_t moves = data.Floats("VEC3", 3, {1, 0, 0, 2, 0, 0, 3, 0, 0});
  const size_t scales = data.Floats("VEC3", 3, {1, 1, 1, 2, 2, 2, 3, 3, 3});
  const size_t turns = data.Accessor(data.View<int8_t>({0, 0, 0, 127, 0, 0, 127, 0, 0, 0, 0, 127}),
                                     "\"normalized\":true," + GltfData::Members(5120, 3, "VEC4"));
  const auto json = [&](const std::string& attributes) {
    return data.Json(kMesh +
                     "\"extensionsRequired\":[\"EXT_mesh_gpu_instancing\"],\"nodes\":[{\"mesh\":0,"
                     "\"translation\":[0,9,0],\"extensions\":{\"EXT_mesh_gpu_instancing\":{"
                     "\"attributes\":{" +
                     attributes + "}}}}]");
  };
  const auto member = [](const char* name, size_t accessor) {
    return std::string("\"") + name + "\":" + std::to_string(accessor);
  };
  const Scene scene = GltfScene(json(member("TRANSLATION", moves) + "," + member("SCALE", scales) +
                                     "," + member("ROTATION", turns)));
  CHECK(scene.triangle_count() == 1);
  REQUIRE(scene.instances.size() == 3);
  CHECK(Origin(scene.instances[1]) == Float3{2, 9, 0});
  CHECK(scene.instances[1].to_world[0] == -2.0f);  // half a turn around z
  CHECK(scene.instances[2].to_world[4] == 3.0f);
  data.Floats("VEC3", 3, {1, 0, 0});
  CheckGltfError(json(member("TRANSLATION", moves) + "," + member("SCALE", 4)),
                 "attributes differ in length");
}

TEST_CASE("glTF: an instance that its node flattens is left out with a warning") {
  const Scene scene = NodesOf(R"({"mesh":0},{"mesh":0,"scale":[0,0,0]},{"mesh":0})");
  CHECK(scene.instances.size() == 2);
  CHECK(test::CountWarnings(scene, "a node flattens its mesh") == 1);
}

TEST_CASE("glTF: hierarchies that are no forest are refused") {
  CheckNodesError(R"({"children":[1]},{"children":[2]},{"children":[1]})", "child of both");
  CheckNodesError(R"({"mesh":0},{"children":[2]},{"children":[1]})", "below itself");
  CheckNodesError(R"({"children":[0]})", "below itself");
  CheckNodesError(R"({"children":[1]},{"children":[2]},{"children":[0]})", "below itself");
  CheckNodesError(R"({"children":[7]})", "not there");
  CheckNodesError(R"({"children":[-1]})", "not there");
  CheckNodesError(R"({"mesh":3})", "no mesh 3");
  std::string chain;
  for (int i = 1; i < 5000; ++i) chain += "{\"children\":[" + std::to_string(i) + "]},";
  CheckNodesError(chain + "{\"mesh\":0}", "more than 4096 nodes deep");
}

TEST_CASE("glTF: only the default scene is shown, else the first, else all roots") {
  const std::string nodes =
      kMesh + R"("nodes":[{"mesh":0},{"mesh":0,"translation":[1,0,0]},{"mesh":0}])";
  const auto corner = [](const Scene& scene) { return scene.positions[0]; };
  const std::string scenes = R"(,"scenes":[{"nodes":[0]},{"nodes":[1]}])";
  CHECK(corner(GltfScene(Triangle().Json(nodes + scenes))) == 0.0f);
  CHECK(corner(GltfScene(Triangle().Json(nodes + scenes + ",\"scene\":1"))) == 1.0f);
  CHECK(GltfScene(Triangle().Json(nodes)).instances.size() == 3);
  CheckGltfError(Triangle().Json(nodes + scenes + ",\"scene\":2"), "no scene 2");
  CheckGltfError(Triangle().Json(nodes + R"(,"scenes":[{"nodes":[0,0]}])"), "has already");
  CheckGltfError(Triangle().Json(nodes + R"(,"scenes":[{"nodes":[9]}])"), "not there");
}

TEST_CASE("glTF: skins and morph targets are told of") {
  const Scene scene = GltfScene(Triangle().Json(
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"targets":[{"POSITION":0}]}]}],
         "skins":[{"joints":[0]}],"nodes":[{"mesh":0,"skin":0}])"));
  CHECK(scene.triangle_count() == 1);
  CHECK(test::CountWarnings(scene, "skins are not supported") == 1);
  CHECK(test::CountWarnings(scene, "morph targets are not supported") == 1);
}

TEST_CASE("glTF: lights shine along -z of their nodes, in the file's own units") {
  const Scene scene = GltfScene(Triangle().Json(kMesh + R"("extensionsUsed":["KHR_lights_punctual"],
      "extensions":{"KHR_lights_punctual":{"lights":[
        {"type":"point","color":[1,0.5,0],"intensity":20},
        {"type":"directional","intensity":3},
        {"type":"spot","intensity":7,"spot":{"innerConeAngle":0.5,"outerConeAngle":1}}]}},
      "nodes":[{"mesh":0},
        {"translation":[1,2,3],"extensions":{"KHR_lights_punctual":{"light":0}}},
        {"rotation":[0.70710678,0,0,0.70710678],"extensions":{"KHR_lights_punctual":{"light":1}}},
        {"scale":[2,2,2],"extensions":{"KHR_lights_punctual":{"light":2}}}])"));
  REQUIRE(scene.lights.size() >= 3);
  const LightRecord& point = scene.lights[0];
  CHECK(point.type == kPointLight);
  CHECK(point.radiance[0] == 20.0f);
  CHECK(point.radiance[1] == 10.0f);
  CHECK(point.p[2] == 3.0f);
  const LightRecord& sun = scene.lights[1];
  CHECK(sun.type == kDistantLight);
  CHECK(sun.radiance[2] == 3.0f);
  CHECK(sun.p[1] == doctest::Approx(-1.0));  // -z turned to +y; towards the light is -y
  const LightRecord& spot = scene.lights[2];
  CHECK(spot.type == kSpotLight);
  CHECK(spot.n[2] == doctest::Approx(-1.0));
  CHECK(spot.e1[0] == doctest::Approx(std::cos(0.5)));
  CHECK(spot.e1[1] == doctest::Approx(std::cos(1.0)));
  CheckGltfError(Triangle().Json(kMesh + R"("extensions":{"KHR_lights_punctual":{"lights":[
        {"type":"area"}]}},"nodes":[{"extensions":{"KHR_lights_punctual":{"light":0}}}])"),
                 "unknown light 'area'");
  CheckGltfError(
      Triangle().Json(kMesh + R"("nodes":[{"extensions":{"KHR_lights_punctual":{"light":0}}}])"),
      "light that is not there");
}

namespace {

const std::string kCameras = kMesh + R"("cameras":[
    {"type":"perspective","name":"wide","perspective":{"yfov":1.0,"aspectRatio":2,"znear":0.1}},
    {"type":"perspective","perspective":{"yfov":1.0,"aspectRatio":0.5,"znear":0.1}},
    {"type":"orthographic","orthographic":{"xmag":3,"ymag":1.5,"znear":0,"zfar":9}}],
  "nodes":[{"mesh":0},{"camera":0,"translation":[0,0,5],"scale":[2,2,2]},
           {"camera":1,"name":"tall"},{"camera":2}])";

Scene CameraOf(const std::string& name) { return GltfScene(Triangle().Json(kCameras), {name}); }

}  // namespace

TEST_CASE("glTF: a camera looks along -z of its node, right is right, and scales do not count") {
  const Scene scene = CameraOf("");
  CHECK(scene.camera.camera_to_world == Affine{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 5});
  CHECK(scene.camera.fov_degrees == doctest::Approx(180 / 3.14159265));
  CHECK(scene.request.width == 1536);
  CHECK(scene.request.height == 768);
}

TEST_CASE("glTF: cameras are chosen by their name, their node's, or their index") {
  CHECK(CameraOf("wide").request.width == 1536);
  const Scene tall = CameraOf("tall");
  CHECK(tall.request.width == 768);
  CHECK(tall.request.height == 1536);
  // The field of view is of the shorter side, here the width.
  CHECK(std::tan(tall.camera.fov_degrees * 3.14159265 / 360) ==
        doctest::Approx(0.5 * std::tan(0.5)));
  const Scene ortho = CameraOf("2");
  CHECK(ortho.camera.type == CameraType::kOrthographic);
  CHECK(ortho.camera.screen_window == std::array<float, 4>{-3, 3, -1.5f, 1.5f});
  test::CheckRefused(test::ReadGltfText(Triangle().Json(kCameras), {"wode"}),
                     "no camera 'wode'; did you mean 'wide'?");
  test::CheckRefused(test::ReadGltfText(Triangle().Json(kMesh + test::kOneNode), {"0"}),
                     "the file has no cameras");
}

TEST_CASE("glTF: what a file lacks of camera and light is added") {
  const Scene bare = NodesOf(R"({"mesh":0})");
  CHECK(bare.request.width == 1024);
  REQUIRE(bare.lights.size() == 1);
  CHECK(bare.lights[0].type == kImageInfiniteLight);
  const Scene filmed = CameraOf("");
  REQUIRE(filmed.lights.size() == 1);
  CHECK(filmed.lights[0].type == kImageInfiniteLight);
}

TEST_CASE("--camera: pbrt scenes and files of other endings say what they take") {
  const test::TemporaryFolder folder;
  const std::string pbrt = folder.Write("scene.pbrt", "WorldBegin"), gltf = folder / "a.gltf";
  test::CheckRefused(ImportScene({pbrt}, {"0"}), "others have one");
  test::CheckRefused(ImportScene({pbrt, gltf}), "only .pbrt files can be read together");
}

}  // namespace swell
