// MTL files: which materials of the scene their statements become.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "src/import/import_scene.h"
#include "tests/import/scene_texts.h"
#include "tests/support/temporary_folder.h"

namespace swell::test {
namespace {

// A PFM of one pixel.
std::string Pixel(float r, float g, float b) {
  std::string bytes = "PF\n1 1\n-1.0\n";
  for (const float value : {r, g, b}) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
  }
  return bytes;
}

// The scene of a triangle whose material's statements are `mtl`.
Scene SceneWith(const std::string& mtl) {
  const TemporaryFolder folder;
  folder.Write("m.mtl", "newmtl m\n" + mtl);
  folder.Write("a b.pfm", Pixel(0.2f, 0.4f, 0.6f));
  folder.Write("normal.pfm", Pixel(0.5f, 0.5f, 1.0f));
  Result<Scene> scene = ImportScene(
      {folder.Write("m.obj", "mtllib m.mtl\nusemtl  m \nv 0 0 0\nv 3 0 0\nv 0 4 0\nf 1 2 3\n")});
  INFO((scene ? "" : scene.error().message));
  REQUIRE(scene);
  return std::move(*scene);
}

const Material& Only(const Scene& scene) {
  REQUIRE(scene.materials.size() == 1);
  return scene.materials[0];
}
std::string KindOf(const Scene& scene) { return kMaterialKinds[Only(scene).kind]->name; }
const float* Words(const Scene& scene, std::string_view name) {
  const MaterialInfo& info = *kMaterialKinds[Only(scene).kind];
  for (uint32_t i = 0; i < info.param_count; ++i) {
    if (info.params[i].name == name) return &Only(scene).params[ParamOffset(info, i)];
  }
  FAIL("no parameter ", std::string(name));
  return nullptr;
}

TEST_CASE("MTL: Kd alone is diffuse, and grey clay where nothing is said") {
  const Scene scene = SceneWith("Ka 1 1 1\nKd 0.1 0.2 0.3\nKs 0 0 0\nNs 10\nillum 2\n");
  CHECK(KindOf(scene) == "diffuse");
  CHECK(Only(scene).name == "m");
  CHECK(Words(scene, "reflectance")[1] == doctest::Approx(0.2));
  CHECK(scene.warnings.empty());
  CHECK(Words(SceneWith(""), "reflectance")[0] == doctest::Approx(0.6));
  CHECK(Words(SceneWith("Kd 0.25\n"), "reflectance")[2] == 0.25f);
  CHECK(KindOf(SceneWith("Kd 1 1 1\nKs 1 1 1\nillum 1\n")) == "diffuse");
}

TEST_CASE("MTL: Kd and Ks are a glossy dielectric; Ks 0.5 reflects 4 % head on") {
  const Scene scene = SceneWith("Kd 0.5 0.5 0.5\nKs 0.5 0.5 0.25\nNs 30\nillum 2\n");
  CHECK(KindOf(scene) == "principled");
  CHECK(Words(scene, "specular")[0] == 1.0f);
  CHECK(Words(scene, "specular_color")[0] == 1.0f);
  CHECK(Words(scene, "specular_color")[2] == 0.5f);
  CHECK(Words(scene, "metallic")[0] == 0.0f);
  CHECK(Words(scene, "roughness")[0] == doctest::Approx(0.5));  // alpha = sqrt(2 / 32)
}

TEST_CASE("MTL: Ks over black is metal, a mirror at illum 3") {
  const Scene scene = SceneWith("Kd 0 0 0\nKs 0.9 0.8 0.7\nNs 6\nillum 2\n");
  CHECK(KindOf(scene) == "conductor");
  CHECK(Words(scene, "reflectance")[1] == doctest::Approx(0.8));
  CHECK(Words(scene, "roughness")[0] == doctest::Approx(0.5));
  CHECK(Words(SceneWith("Kd 0 0 0\nKs 1 1 1\nNs 6\nillum 3\n"), "roughness")[0] == 0.0f);
}

TEST_CASE("MTL: illum 7 is glass that refracts, illum 4 a pane, d a hole elsewhere") {
  const Scene body = SceneWith("Ks 1 1 1\nNi 1.33\nTf 0.25 1 1\nillum 7\n");
  CHECK(KindOf(body) == "dielectric");
  CHECK(Words(body, "eta")[0] == doctest::Approx(1.33));
  CHECK(Words(body, "transmittance")[0] == 0.5f);  // crossed twice
  const Scene pane = SceneWith("Kd 0 0 0\nd 0.1\nillum 4\n");
  CHECK(KindOf(pane) == "principled");
  CHECK(Words(pane, "transmission")[0] == 1.0f);
  CHECK(pane.shapes[0].alpha == kNoTexture);
  const Scene veil = SceneWith("Kd 1 1 1\nTr 0.75\nillum 2\n");
  REQUIRE(veil.shapes[0].alpha != kNoTexture);
  CHECK(veil.texture_nodes[veil.shapes[0].alpha].value[0] == 0.25f);
  const Scene both = SceneWith("Tr 0.9\nd 0.5\n");
  CHECK(both.texture_nodes[both.shapes[0].alpha].value[0] == 0.5f);
  CHECK(Warns(SceneWith("d 0\n"), "m.mtl:1: material 'm' cannot be seen"));
}

TEST_CASE("MTL: Pr, Pm, Ps, Pc and Pcr are the principled material's") {
  const Scene scene =
      SceneWith("Kd 0.1 0.2 0.3\nPr 0.2\nPm 0.3\nPs 0.4\nPc 0.5\nPcr 0.6\nNi 1.4\n");
  CHECK(KindOf(scene) == "principled");
  for (const auto& [name, value] : {std::pair{"roughness", 0.2},
                                    {"metallic", 0.3},
                                    {"sheen_color", 0.4},
                                    {"clearcoat", 0.5},
                                    {"clearcoat_roughness", 0.6},
                                    {"ior", 1.4}}) {
    CHECK(Words(scene, name)[0] == doctest::Approx(value));
  }
}

TEST_CASE("MTL: Ke shines from both sides, by an image if there is one") {
  const Scene lamp = SceneWith("Kd 0 0 0\nKe 5 6 7\n");
  CHECK(lamp.shapes[0].emits);
  CHECK(lamp.shapes[0].two_sided);
  CHECK(lamp.shapes[0].radiance[2] == 7.0f);
  CHECK_FALSE(SceneWith("Ke 0 0 0\n").shapes[0].emits);
  const Scene picture = SceneWith("map_Ke a b.pfm\n");
  REQUIRE(picture.shapes[0].emission_image != kNoTexture);
  CHECK(picture.shapes[0].radiance[0] == 1.0f);
  CHECK(picture.image_lights[picture.shapes[0].emission_image].image.name.find("a b.pfm") !=
        std::string::npos);
}

TEST_CASE("MTL: textures with their options, each file once; names may hold spaces") {
  const Scene scene = SceneWith(
      "Kd 0.5 0.5 1\nmap_Kd -clamp on -o 0.1 -s 2 3 a b.pfm\nPr 0.5\nmap_Pr .\\a b.pfm -bm 2\n"
      "map_d a b.pfm\nmap_Pm a b.pfm\n");
  CHECK(Only(scene).textures.size() == 3);
  CHECK(scene.images.size() == 3);  // of colours; of numbers, as two spellings of one path
  const TextureStep& image = scene.texture_nodes[0];
  CHECK(image.op == TextureOp::kImage);
  CHECK(image.wrap == TextureWrap::kClamp);
  CHECK(image.map[0] == 2.0f);
  CHECK(image.map[1] == 3.0f);
  CHECK(image.map[2] == doctest::Approx(0.1));
  CHECK(scene.texture_nodes[2].op == TextureOp::kScale);
  CHECK(scene.shapes[0].alpha != kNoTexture);
  CHECK(scene.warnings.empty());
  CHECK(Words(SceneWith("Kd 0 0 0\nmap_Kd a b.pfm\n"), "reflectance")[0] > 0.0f);
}

TEST_CASE("MTL: bump maps tilt by height, those that hold normals by these") {
  const Scene heights = SceneWith("bump -bm 3 a b.pfm\n");
  REQUIRE(Only(heights).displacement != kNoTexture);
  CHECK(heights.texture_nodes[Only(heights).displacement].value[0] ==
        doctest::Approx(3 * 0.01 * 5.0));
  CHECK(Only(SceneWith("map_Bump normal.pfm\n")).normal_map != kNoTexture);
  CHECK(Only(SceneWith("norm a b.pfm\n")).normal_map != kNoTexture);
}

TEST_CASE("MTL: what is missing, wrong or unknown is a warning with its line") {
  const Scene scene = SceneWith(
      "Kd 1 x 1\nKs 1 1\nillum two\nNs 1e400\nmap_Kd none.png\nmap_Ks\nmap_Kd -o q.png\nKdd 1\n"
      "aniso 0.5\nrefl r.png\nNi 1e99\nnewmtl m\nKd 1 1 1\n");
  for (const char* fragment :
       {"m.mtl:2: 'Kd' has 'x', which is no number", "m.mtl:3: 'Ks' needs 3 numbers, not 2",
        "m.mtl:4: 'illum' has 'two'", "m.mtl:5: 'Ns' has '1e400'",
        "none.png' does not exist; its material goes without", "m.mtl:7: 'map_Ks' names no file",
        "m.mtl:8: 'map_Kd': the option '-o' lacks its value",
        "m.mtl:9: unknown statement 'Kdd' is ignored; did you mean 'Kd'?",
        "m.mtl:10: 'aniso' is not supported", "'refl' is not supported", "m.mtl:12: 'Ni' has",
        "m.mtl:13: a material of that name came before"}) {
    INFO(fragment);
    CHECK(Warns(scene, fragment));
  }
  CHECK(KindOf(scene) == "diffuse");
  CHECK(Words(scene, "reflectance")[0] == 1.0f);  // white under the texture that is missing
}

TEST_CASE("MTL: materials are found in whichever library has them, clay replaces the others") {
  const TemporaryFolder folder;
  folder.Write("a b.mtl", "newmtl a\nKd 0.1 0.1 0.1\n");
  folder.Write("c.mtl", "Kd 1 1 1\nnewmtl c d\nKd 0.2 0.2 0.2\n");
  const Result<Scene> scene = ImportScene({folder.Write(
      "m.obj",
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl c d\nf 1 2 3\nusemtl a\nf 1 2 3\nusemtl e\n"
      "f 1 2 3\nusemtl unused\nmtllib a b.mtl\nmtllib none.mtl c.mtl\n")});
  REQUIRE(scene);
  REQUIRE(scene->materials.size() == 3);
  CHECK(scene->shapes[0].record.material == scene->shapes[3].record.material);
  CHECK(scene->materials[scene->shapes[1].record.material].name == "c d");
  CHECK(scene->materials[scene->shapes[2].record.material].name == "a");
  CHECK(Warns(*scene, "c.mtl:1: 'Kd' comes before any newmtl"));
  CHECK(Warns(*scene, "m.obj:9: material 'e' is not in any mtllib; grey clay replaces it"));
  CHECK(scene->warnings.size() == 2);
}

}  // namespace
}  // namespace swell::test
