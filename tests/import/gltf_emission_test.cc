// glTF emission: factors, images, what of them is dark, and the sky where all is.
#include <array>

#include "tests/import/gltf_material_texts.h"

namespace swell {
namespace {

using test::Extension;
using test::KindOf;
using test::kPbr;
using test::kTexture0;
using test::kTextures;
using test::SquareOf;
using test::Value;

}  // namespace

TEST_CASE("glTF: emission is its factor times its strength, of both sides if there are two") {
  const Scene scene =
      SquareOf("\"emissiveFactor\":[1,0.5,0],\"doubleSided\":true," +
               Extension("KHR_materials_emissive_strength", "\"emissiveStrength\":8"));
  REQUIRE(scene.shapes.size() == 1);
  CHECK(scene.shapes[0].emits);
  CHECK(scene.shapes[0].two_sided);
  CHECK(scene.shapes[0].radiance == std::array<float, 3>{8, 4, 0});
  CHECK(scene.shapes[0].emission_image == kNoTexture);
  const Scene pictured =
      SquareOf("\"emissiveFactor\":[1,1,1],\"emissiveTexture\":" + kTexture0, kTextures);
  REQUIRE(pictured.shapes[0].emission_image == 0);
  CHECK_FALSE(pictured.shapes[0].two_sided);
  CHECK(pictured.image_lights[0].mapping == ImageMapping::kSurface);
  CHECK(TexelAt(pictured.image_lights[0].image, 0, 1, 0) == std::array<float, 3>{0, 1, 0});
  CHECK_FALSE(SquareOf("\"emissiveTexture\":" + kTexture0, kTextures).shapes[0].emits);
}

namespace {

// 8 x 8 texels, white in column 6 of row 1, else black.
const std::string kDots =
    "\"textures\":[{\"source\":0,\"sampler\":0}],\"images\":[{\"uri\":\"data:image/png;base64,"
    "iVBORw0KGgoAAAANSUhEUgAAAAgAAAAICAIAAABLbSncAAAAEklEQVR42mNgIB78//+fYbACANAGAv6U1PidAAAAAElF"
    "TkSuQmCC\"}]";

}  // namespace

TEST_CASE("glTF: triangles that show only black of an emissive texture are no lights") {
  const std::string material = "\"emissiveFactor\":[1,1,1],\"emissiveTexture\":" + kTexture0;
  // Two triangles a quarter of the image wide, at `a` and at `b`; wrapped alike along both axes.
  const auto scene_of = [&](std::array<float, 2> a, std::array<float, 2> b, int wrap = 33071) {
    test::GltfData data;
    data.Floats("VEC3", 3, {0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 0, 0, 6, 0, 0, 5, 1, 0});
    data.Floats("VEC2", 2,
                {a[0], a[1], a[0] + 0.25f, a[1], a[0], a[1] + 0.25f, b[0], b[1], b[0] + 0.25f, b[1],
                 b[0], b[1] + 0.25f});
    data.Indices({0, 1, 2, 3, 4, 5});
    return test::GltfScene(data.Json("\"meshes\":[{" + test::kSquare + "}]," + test::kOneNode +
                                     ",\"materials\":[{" + material + "}]," + kDots +
                                     ",\"samplers\":[{\"wrapS\":" + std::to_string(wrap) +
                                     ",\"wrapT\":" + std::to_string(wrap) + "}]"));
  };
  const std::array<float, 2> black{0.125f, 0.5f}, white{0.75f, 0.125f}, beside{0.9f, 0.0f};
  const Scene half = scene_of(black, white);
  REQUIRE(half.shapes.size() == 2);
  CHECK(half.shapes[0].emits);
  CHECK(half.shapes[0].record.first_prim == 0);
  CHECK(half.shapes[0].record.prim_count == 1);
  CHECK_FALSE(half.shapes[1].emits);
  CHECK(half.shapes[1].record.first_prim == 1);
  CHECK(half.shapes[1].record.prim_count == 1);
  CHECK(half.prim_shape == std::vector<uint32_t>{0, 1});
  CHECK(half.positions[3 * size_t{half.indices[0]}] == 5.0f);  // the second of the file is lit
  CHECK(half.positions[3 * size_t{half.indices[3]}] == 0.0f);
  CHECK(half.shapes[0].record.uv_offset == half.shapes[1].record.uv_offset);

  const Scene lit = scene_of(white, beside);  // blends with the white texel
  REQUIRE(lit.shapes.size() == 1);
  CHECK(lit.shapes[0].emits);
  CHECK(lit.shapes[0].record.prim_count == 2);
  // Beyond the image its edge goes on, which is black.
  const Scene dark = scene_of(black, {1.75f, 0.125f});
  REQUIRE(dark.shapes.size() == 1);
  CHECK_FALSE(dark.shapes[0].emits);
  CHECK(dark.shapes[0].record.prim_count == 2);

  constexpr int kRepeat = 10497, kMirror = 33648;
  const auto lit_triangles = [&](std::array<float, 2> b, int wrap) {
    const Scene scene = scene_of(black, b, wrap);
    return scene.shapes[0].emits ? scene.shapes[0].record.prim_count : 0;
  };
  CHECK(lit_triangles({1.75f, 0.125f}, kRepeat) == 1);
  CHECK(lit_triangles({-0.25f, -0.875f}, kRepeat) == 1);
  CHECK(lit_triangles({1.125f, 0.5f}, kRepeat) == 0);
  CHECK(lit_triangles({0.9f, 0.125f}, kRepeat) == 1);   // begins beside the white texel
  CHECK(lit_triangles({-1.0f, 0.125f}, kMirror) == 1);  // 0.75 to 1 from the right
  CHECK(lit_triangles({-0.25f, 0.125f}, kMirror) == 0);
  CHECK(lit_triangles({1.0f, 0.125f}, kMirror) == 1);
  CHECK(lit_triangles({1.5f, 0.125f}, kMirror) == 0);
}

TEST_CASE("glTF: a model that is filmed gets the soft sky unless some of it is a lamp") {
  // A square on black texels of kDots, or on all of them.
  const auto lights = [&](const std::string& material, float size) {
    test::GltfData data;
    data.Floats("VEC3", 3, {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    data.Floats(
        "VEC2", 2,
        {0.25f, 0.75f, 0.25f + size, 0.75f, 0.25f + size, 0.75f - size, 0.25f, 0.75f - size});
    data.Indices({0, 1, 2, 0, 2, 3});
    const Scene scene = test::GltfScene(data.Json(
        "\"meshes\":[{" + test::kSquare + "}],\"materials\":[{" + material + "}]," + kDots +
        R"(,"nodes":[{"mesh":0},{"camera":0,"translation":[0,0,5]}],
                  "cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":0.1}}])"));
    return scene.lights.size();
  };
  const auto emissive = [](double factor) {
    return "\"emissiveFactor\":[" + std::to_string(factor) +
           ",0,0],\"emissiveTexture\":" + kTexture0 + "," +
           Extension("KHR_materials_emissive_strength", "\"emissiveStrength\":8");
  };
  CHECK(lights(emissive(1.0), 1.0f) == 0);
  CHECK(lights(emissive(1.0), 0.25f) == 1);  // what it shows of the picture is black
  CHECK(lights(emissive(0.1), 1.0f) == 1);   // 0.8 is no more than white reflects
}

TEST_CASE("glTF: unlit surfaces emit their base colour and reflect nothing") {
  const Scene scene = SquareOf(kPbr + "{\"baseColorFactor\":[0.5,0.25,0,1]}," +
                               Extension("KHR_materials_unlit", ""));
  CHECK(KindOf(scene.materials[0]) == "diffuse");
  CHECK(Value(scene.materials[0], "reflectance") == 0.0f);
  CHECK(scene.shapes[0].radiance == std::array<float, 3>{0.5f, 0.25f, 0});
}

}  // namespace swell
