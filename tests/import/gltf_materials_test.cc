// glTF materials: factors and textures as parameters, opacity, volumes, and what is told of.
#include <array>
#include <cmath>
#include <optional>

#include "tests/import/gltf_material_texts.h"

namespace swell {
namespace {

using test::CountWarnings;
using test::Extension;
using test::KindOf;
using test::kPbr;
using test::kTexture0;
using test::kTextures;
using test::NodeOf;
using test::SquareOf;
using test::Value;

}  // namespace

TEST_CASE("glTF: a material's factors are parameters of principled, without it glTF's defaults") {
  const Scene scene = SquareOf(
      kPbr + R"({"baseColorFactor":[0.5,0.25,1,1],"metallicFactor":0.5,"roughnessFactor":0.75})");
  const Material& material = scene.materials[0];
  CHECK(KindOf(material) == "principled");
  CHECK(Value(material, "base_color", 1) == 0.25f);
  CHECK(Value(material, "metallic") == 0.5f);
  CHECK(Value(material, "roughness") == 0.75f);
  CHECK(Value(material, "ior") == 1.5f);
  CHECK(scene.warnings.empty());
  const Scene plain = test::GltfScene(test::SquareData().Json(
      "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":2}]}]," +
      test::kOneNode));
  CHECK(Value(plain.materials[0], "metallic") == 1.0f);
  CHECK(Value(plain.materials[0], "base_color") == 1.0f);
}

TEST_CASE("glTF: the extensions of glossy layers set their parameters") {
  const auto check = [](const char* extension, const char* members, const char* parameter,
                        double expected) {
    const Scene scene = SquareOf(Extension(extension, members));
    CAPTURE(parameter);
    CHECK(Value(scene.materials[0], parameter) == doctest::Approx(expected));
    CHECK(scene.warnings.empty());
  };
  check("KHR_materials_ior", "\"ior\":1.25", "ior", 1.25);
  check("KHR_materials_specular", "\"specularFactor\":0.5", "specular", 0.5);
  check("KHR_materials_specular", "\"specularColorFactor\":[2,1,1]", "specular_color", 2);
  check("KHR_materials_transmission", "\"transmissionFactor\":0.75", "transmission", 0.75);
  check("KHR_materials_clearcoat", "\"clearcoatFactor\":0.5", "clearcoat", 0.5);
  check("KHR_materials_clearcoat", "\"clearcoatRoughnessFactor\":0.25", "clearcoat_roughness",
        0.25);
  check("KHR_materials_anisotropy", "\"anisotropyStrength\":0.5", "anisotropy", 0.5);
  check("KHR_materials_sheen", "\"sheenColorFactor\":[0.25,0,0]", "sheen_color", 0.25);
  check("KHR_materials_sheen", "\"sheenRoughnessFactor\":0.5", "sheen_roughness", 0.5);
}

TEST_CASE("glTF: textures give parameters by the channels that the specification names") {
  const Scene scene = SquareOf(kPbr + "{\"baseColorTexture\":" + kTexture0 +
                                   ",\"metallicRoughnessTexture\":" + kTexture0 + "}",
                               kTextures);
  CHECK(scene.materials[0].textures.size() == 3);
  const auto texel = [&](const char* parameter, uint32_t x, uint32_t y) {
    const std::optional<TextureStep> node = NodeOf(scene, parameter);
    REQUIRE(node);
    REQUIRE(node->op == TextureOp::kImage);
    return TexelAt(scene.images[node->image], 0, x, y);
  };
  CHECK(texel("base_color", 1, 0) == std::array<float, 3>{0, 1, 0});
  CHECK(texel("roughness", 1, 0)[0] == 1.0f);  // green
  CHECK(texel("roughness", 0, 1)[0] == 0.0f);
  CHECK(texel("metallic", 1, 0)[0] == 0.0f);  // blue
  CHECK(texel("metallic", 0, 1)[0] == 1.0f);
}

TEST_CASE("glTF: opacity counts as the alpha mode says") {
  const auto alpha = [](const std::string& members, const std::string& base) {
    const Scene scene = SquareOf(members + kPbr + "{" + base + "}", kTextures);
    std::vector<TextureStep> steps;
    if (scene.shapes[0].alpha != kNoTexture) {
      for (uint32_t node : NodesBelow(scene.texture_nodes, scene.shapes[0].alpha)) {
        steps.push_back(scene.texture_nodes[node]);
      }
    }
    return std::pair(scene, steps);
  };
  const std::string texture = "\"baseColorTexture\":" + kTexture0;
  const std::string half = "\"baseColorFactor\":[1,1,1,0.5]";
  CHECK(alpha("", half).second.empty());
  CHECK(alpha("\"alphaMode\":\"OPAQUE\",", texture).second.empty());
  const auto [blend, steps] = alpha("\"alphaMode\":\"BLEND\",", texture);
  REQUIRE(steps.size() == 1);
  CHECK(TexelAt(blend.images[steps[0].image], 0, 1, 0)[0] == doctest::Approx(128 / 255.0));
  const auto constant = alpha("\"alphaMode\":\"BLEND\",", half).second;
  REQUIRE(constant.size() == 1);
  CHECK(constant[0].value[0] == 0.5f);
  CHECK(alpha("\"alphaMode\":\"BLEND\",", texture + "," + half).second.size() == 3);
  const auto mask = alpha("\"alphaMode\":\"MASK\",\"alphaCutoff\":0.25,", texture).second;
  REQUIRE(mask.size() == 2);
  CHECK(mask[1].op == TextureOp::kStep);
  CHECK(mask[1].value[0] == 0.25f);
  CHECK(alpha("\"alphaMode\":\"MASK\",", half).second.empty());  // 0.5 is not below the cutoff
  const auto hidden = alpha("\"alphaMode\":\"MASK\",\"alphaCutoff\":0.75,", half).second;
  REQUIRE(hidden.size() == 1);
  CHECK(hidden[0].value[0] == 0.0f);
}

TEST_CASE("glTF: what transmits and has a thickness is solid glass around what absorbs") {
  // The faces of a tetrahedron from `first` on.
  const auto scene_of = [](const std::string& volume, size_t first = 0) {
    std::vector<uint16_t> faces{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    faces.erase(faces.begin(), faces.begin() + static_cast<ptrdiff_t>(3 * first));
    test::GltfData data;
    data.Floats("VEC3", 3, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1});
    data.Floats("VEC2", 2, {0, 0, 0, 0, 0, 0, 0, 0});
    data.Indices(faces);
    return test::GltfScene(data.Json("\"meshes\":[{" + test::kSquare + "}]," + test::kOneNode +
                                     ",\"materials\":[{" + kPbr +
                                     R"({"baseColorFactor":[0.25,1,1,1],"metallicFactor":0,
        "roughnessFactor":0.5},"extensions":{"KHR_materials_transmission":
        {"transmissionFactor":1},"KHR_materials_ior":{"ior":1.25},"KHR_materials_volume":{)" +
                                     volume + "}}}]"));
  };
  const std::string density = R"("attenuationDistance":2,"attenuationColor":[1,0.5,0])";
  const std::string thick = "\"thicknessFactor\":7,", thin = "\"thicknessFactor\":0,";
  const Scene solid = scene_of(thick + density);
  const Material& glass = solid.materials[0];
  CHECK(KindOf(glass) == "dielectric");
  CHECK(Value(glass, "eta") == 1.25f);
  CHECK(Value(glass, "roughness") == 0.25f);  // alpha
  CHECK(Value(glass, "remaproughness") == 0.0f);
  CHECK(Value(glass, "transmittance", 0) == 0.5f);  // twice: the base colour
  CHECK(Value(glass, "transmittance", 1) == 1.0f);
  CHECK(solid.warnings.empty());
  REQUIRE(solid.media.size() == 2);
  CHECK(solid.shapes[0].inside == 1);
  CHECK(solid.shapes[0].outside == kVacuum);
  CHECK(solid.media[1].absorption[0] == 0.0f);
  CHECK(solid.media[1].absorption[1] == doctest::Approx(std::log(2.0) / 2));
  CHECK(solid.media[1].absorption[2] > 40.0f);  // nothing is left
  CHECK(std::isfinite(solid.media[1].absorption[2]));

  const Scene open = scene_of(thick + density, 1);
  CHECK(open.shapes[0].inside == kVacuum);
  CHECK(CountWarnings(open, "not closed") == 1);
  const Scene clear = scene_of(thick + "\"attenuationColor\":[0,0,0]");  // at infinity
  CHECK(KindOf(clear.materials[0]) == "dielectric");
  CHECK(clear.media.size() == 1);
  const Scene wall = scene_of(thin + density);
  CHECK(KindOf(wall.materials[0]) == "principled");
  CHECK(wall.media.size() == 1);
  CHECK(wall.shapes[0].inside == kVacuum);
}

TEST_CASE(
    "glTF: a metalness of a texture keeps no volume from being glass, one of all of it does") {
  const std::string glass = R"(,"extensions":{"KHR_materials_transmission":{"transmissionFactor":1},
      "KHR_materials_volume":{"thicknessFactor":1}})";
  const auto kind = [&](const std::string& factors) {
    return KindOf(SquareOf(kPbr + factors + glass, kTextures).materials[0]);
  };
  CHECK(kind(R"({"metallicRoughnessTexture":{"index":0}})") == "dielectric");
  CHECK(kind(R"({"metallicFactor":1})") == "principled");
}

TEST_CASE("glTF: what is not supported of materials is told once for each kind") {
  const auto check = [](const std::string& name, const std::string& members,
                        std::string_view fragment) {
    CHECK(CountWarnings(SquareOf(Extension(name, members), kTextures), fragment) == 1);
  };
  check("KHR_materials_iridescence", "\"iridescenceFactor\":1", "KHR_materials_iridescence");
  check("KHR_materials_dispersion", "\"dispersion\":1", "KHR_materials_dispersion");
}

TEST_CASE("glTF: dispersion is kept with its material") {
  const std::string disperses = Extension("KHR_materials_dispersion", "\"dispersion\":0.5");
  CHECK(SquareOf(disperses, kTextures).materials[0].dispersion == 0.5f);
}

TEST_CASE("glTF: materials and textures that are not there are refused") {
  const auto refuse = [](const std::string& material, std::string_view fragment) {
    test::CheckRefused(test::ReadGltfText(test::SquareData().Json(
                           "\"meshes\":[{" + test::kSquare + "}]," + test::kOneNode + material)),
                       fragment);
  };
  refuse("", "no material 0");
  const std::string base =
      ",\"materials\":[{" + kPbr + "{\"baseColorTexture\":" + kTexture0 + "}}]";
  refuse(base, "no texture 0");
  refuse(base + ",\"textures\":[{\"source\":3}]", "no image 3");
}

}  // namespace swell
