// glTF textures: samplers, transforms, sets of coordinates, maps of normals and their tangents.
#include <array>
#include <optional>

#include "tests/import/gltf_material_texts.h"

namespace swell {
namespace {

using test::CountWarnings;
using test::Extension;
using test::kPbr;
using test::kTexture0;
using test::kTextures;
using test::NodeOf;
using test::SquareOf;
using test::Value;

}  // namespace

TEST_CASE("glTF: a factor multiplies its texture, and a black one leaves it out") {
  const auto scene_of = [](const std::string& factor) {
    return SquareOf(
        kPbr + "{\"baseColorFactor\":" + factor + ",\"baseColorTexture\":" + kTexture0 + "}",
        kTextures);
  };
  const Scene scaled = scene_of("[0.5,1,1,1]");
  const std::optional<TextureStep> node = NodeOf(scaled, "base_color");
  REQUIRE(node);
  CHECK(node->op == TextureOp::kScale);
  CHECK(scaled.texture_nodes[node->input[0]].value[0] == 0.5f);
  CHECK_FALSE(NodeOf(scene_of("[0,0,0,1]"), "base_color"));
}

TEST_CASE("glTF: samplers wrap along both axes by themselves, and magnify by the nearest texel") {
  const Scene scene =
      SquareOf(kPbr + "{\"baseColorTexture\":{\"index\":1}}",
               kTextures + ",\"samplers\":[{\"wrapS\":33648,\"wrapT\":33071,\"magFilter\":9728}]");
  const std::optional<TextureStep> node = NodeOf(scene, "base_color");
  REQUIRE(node);
  CHECK(node->wrap == TextureWrap::kMirror);
  CHECK(node->wrap_t == TextureWrap::kClamp);
  CHECK(node->filter == TextureFilter::kPoint);
}

TEST_CASE("glTF: KHR_texture_transform of all textures alike moves the mesh's coordinates") {
  const Scene scene =
      SquareOf(kPbr +
                   "{\"baseColorTexture\":{\"index\":0,\"extensions\":{\"KHR_texture_transform\":"
                   "{\"offset\":[0,1],\"rotation\":1.57079632679,\"scale\":[0.5,0.5]}}}}",
               kTextures);
  // The extension's own example: the lower left quadrant of the image, turned.
  const double expected[4][2] = {{0.5, 1}, {0.5, 0.5}, {0, 0.5}, {0, 1}};
  REQUIRE(scene.uvs.size() == 8);
  for (size_t i = 0; i < 4; ++i) {
    CHECK(scene.uvs[2 * i] == doctest::Approx(expected[i][0]).epsilon(1e-5));
    CHECK(scene.uvs[2 * i + 1] == doctest::Approx(1 - expected[i][1]).epsilon(1e-5));
  }
  const TextureStep node = *NodeOf(scene, "base_color");
  CHECK(node.mapping == TextureMapping::kUv);
  CHECK(node.map[0] == 1.0f);
  CHECK(node.map[3] == 0.0f);
}

TEST_CASE("glTF: a transform that one texture has alone is in its own node") {
  const auto scene_of = [](const std::string& transform) {
    return SquareOf(kPbr + "{\"baseColorTexture\":" + kTexture0 +
                        ",\"metallicRoughnessTexture\":{\"index\":0,\"extensions\":"
                        "{\"KHR_texture_transform\":{" +
                        transform + "}}}}",
                    kTextures);
  };
  const TextureStep moved = *NodeOf(scene_of("\"offset\":[0.25,0.5],\"scale\":[2,4]"), "roughness");
  CHECK(moved.mapping == TextureMapping::kUv);
  // t = 4 (1 - v) + 0.5 from the top: 1 - t = 4 v - 3.5.
  CHECK(std::array<float, 4>{moved.map[0], moved.map[1], moved.map[2], moved.map[3]} ==
        std::array<float, 4>{2, 4, 0.25f, -3.5f});
  const TextureStep turned = *NodeOf(scene_of("\"rotation\":1.57079632679"), "roughness");
  CHECK(turned.mapping == TextureMapping::kUvAffine);
  // s = v down = 1 - v; t = -u, so 1 - t = 1 + u.
  const float expected[6] = {0, -1, 1, 1, 0, 1};
  for (int i = 0; i < 6; ++i) CHECK(turned.map[i] == doctest::Approx(expected[i]).epsilon(1e-5));
}

TEST_CASE("glTF: anisotropy has a rotation and, by its texture, directions") {
  const Scene turned = SquareOf(
      Extension("KHR_materials_anisotropy", "\"anisotropyStrength\":1,\"anisotropyRotation\":0.5"));
  CHECK(Value(turned.materials[0], "anisotropy_rotation") == 0.5f);
  CHECK(Value(turned.materials[0], "anisotropy_direction", 0) == 1.0f);  // u
  CHECK(Value(turned.materials[0], "anisotropy_direction", 1) == 0.5f);
  CHECK(turned.uvs.size() == 8);
  const Scene textured =
      SquareOf(Extension("KHR_materials_anisotropy",
                         "\"anisotropyStrength\":1,\"anisotropyTexture\":{\"index\":0}"),
               kTextures);
  const std::optional<TextureStep> node = NodeOf(textured, "anisotropy_direction");
  REQUIRE(node);
  CHECK(TexelAt(textured.images[node->image], 0, 1, 0) == std::array<float, 3>{0, 1, 0});
  CHECK(NodeOf(textured, "anisotropy"));
  CHECK(textured.warnings.empty());
}

namespace {

// A square of one material with a second set of coordinates, all (0.5, 0.5), and maybe a third.
Scene TwoSetsOf(const std::string& material, bool third = false) {
  test::GltfData data = test::SquareData();
  data.Floats("VEC2", 2, {0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f});
  return test::GltfScene(data.Json(
      "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,"
      "\"TEXCOORD_0\":1,\"TEXCOORD_1\":3" +
      std::string(third ? ",\"TEXCOORD_2\":3" : "") + "},\"indices\":2,\"material\":0}]}]," +
      test::kOneNode + ",\"materials\":[{" + material + "}]," + kTextures));
}
const std::string kTexture1 = "{\"index\":0,\"texCoord\":1}";

}  // namespace

TEST_CASE("glTF: textures that are all of a second set of coordinates have it as the first") {
  const Scene scene = TwoSetsOf(kPbr + "{\"baseColorTexture\":" + kTexture1 + "}");
  REQUIRE(scene.uvs.size() == 8);
  CHECK(scene.uvs[0] == 0.5f);
  CHECK(scene.shapes[0].second_uv_offset == kNone);
  CHECK(NodeOf(scene, "base_color")->second_uvs == 0);
  CHECK(scene.warnings.empty());
}

TEST_CASE("glTF: textures of two sets of coordinates have both, by the transform's choice too") {
  for (const std::string& info :
       {kTexture1, std::string("{\"index\":0,\"extensions\":{\"KHR_texture_transform\":"
                               "{\"texCoord\":1}}}")}) {
    const Scene scene = TwoSetsOf(kPbr + "{\"baseColorTexture\":" + kTexture0 +
                                  ",\"metallicRoughnessTexture\":" + info + "}");
    REQUIRE(scene.uvs.size() == 16);
    CHECK(scene.uvs[0] == 0.0f);
    CHECK(scene.uvs[8] == 0.5f);
    CHECK(scene.shapes[0].record.uv_offset == 0);
    CHECK(scene.shapes[0].second_uv_offset == 4);
    CHECK(NodeOf(scene, "base_color")->second_uvs == 0);
    CHECK(NodeOf(scene, "roughness")->second_uvs == 1);
    CHECK(scene.warnings.empty());
  }
}

TEST_CASE("glTF: a third set of coordinates in a material, or one that a mesh lacks, is told of") {
  const std::string two = kPbr + "{\"baseColorTexture\":" + kTexture0 +
                          ",\"metallicRoughnessTexture\":" + kTexture1 + "},";
  const Scene scene = TwoSetsOf(
      two + Extension("KHR_materials_clearcoat",
                      "\"clearcoatFactor\":1,\"clearcoatTexture\":{\"index\":0,\"texCoord\":2}"),
      /*third=*/true);
  CHECK_FALSE(NodeOf(scene, "clearcoat"));
  CHECK(CountWarnings(scene, "a texture of TEXCOORD_2 is left out") == 1);
  const Scene lacks = SquareOf(kPbr + "{\"baseColorTexture\":" + kTexture0 +
                                   ",\"metallicRoughnessTexture\":" + kTexture1 + "}",
                               kTextures);
  CHECK_FALSE(NodeOf(lacks, "roughness"));
  CHECK(CountWarnings(lacks, "a texture of TEXCOORD_1 is left out") == 1);
}

TEST_CASE("glTF: emission that is mapped unlike the normal map has coordinates of its own") {
  const std::string normal = "\"normalTexture\":" + kTexture0 + ",\"emissiveFactor\":[1,1,1],";
  const Scene set = TwoSetsOf(normal + "\"emissiveTexture\":" + kTexture1);
  REQUIRE(set.shapes[0].second_uv_offset == 4);
  CHECK(set.uvs[8] == 0.5f);
  REQUIRE(set.shapes[0].emission_image == 0);
  CHECK(set.image_lights[0].lookup.second_uvs == 1);
  const Scene moved = SquareOf(normal +
                                   "\"emissiveTexture\":{\"index\":0,\"extensions\":{"
                                   "\"KHR_texture_transform\":{\"offset\":[0.25,0]}}}",
                               kTextures);
  REQUIRE(moved.shapes[0].second_uv_offset == 4);
  CHECK(moved.uvs[0] == 0.0f);
  CHECK(moved.uvs[8] == 0.25f);
  CHECK(moved.warnings.empty());
  const Scene alike = SquareOf(normal + "\"emissiveTexture\":" + kTexture0, kTextures);
  CHECK(alike.shapes[0].second_uv_offset == kNone);
  CHECK(alike.image_lights[0].lookup.second_uvs == 0);
}

TEST_CASE("glTF: emission wraps as its sampler says, by default it repeats") {
  const auto lookup = [](const std::string& texture, const std::string& samplers) {
    const Scene scene =
        SquareOf("\"emissiveFactor\":[1,1,1],\"emissiveTexture\":{\"index\":" + texture + "}",
                 kTextures + samplers);
    return scene.image_lights[scene.shapes[0].emission_image].lookup;
  };
  const SurfaceLookup plain = lookup("0", "");
  CHECK(plain.wrap == TextureWrap::kRepeat);
  CHECK(plain.wrap_t == TextureWrap::kRepeat);
  CHECK(plain.filter == TextureFilter::kBilinear);
  const SurfaceLookup own =
      lookup("1", ",\"samplers\":[{\"wrapS\":33648,\"wrapT\":33071,\"magFilter\":9728}]");
  CHECK(own.wrap == TextureWrap::kMirror);
  CHECK(own.wrap_t == TextureWrap::kClamp);
  CHECK(own.filter == TextureFilter::kPoint);
}

TEST_CASE("glTF: a mesh without coordinates has its material's factors only") {
  const Scene scene = test::GltfScene(test::SquareData().Json(
      "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":2,"
      "\"material\":0}]}],\"materials\":[{" +
      kPbr + "{\"baseColorTexture\":" + kTexture0 + "}}]," + kTextures + "," + test::kOneNode));
  CHECK(scene.materials[0].textures.empty());
  CHECK(scene.images.empty());
}

TEST_CASE("glTF: a normal map stands by its scale and follows v") {
  const Scene scene = SquareOf("\"normalTexture\":{\"index\":0,\"scale\":0.5}", kTextures);
  const Material& material = scene.materials[0];
  REQUIRE(material.normal_map == 0);
  CHECK(scene.texture_nodes[0].op == TextureOp::kImage);
  CHECK(scene.texture_nodes[0].image == 0);
  CHECK(scene.images[0].levels.size() == 1);  // it is not filtered
  CHECK(material.normal_map_follows_v);
  const std::array<float, 3> red = TexelAt(scene.images[0], 0, 0, 0);  // slopes 1 and -1
  CHECK(red[0] == doctest::Approx(0.75).epsilon(1e-3));
  CHECK(red[1] == doctest::Approx(0.25).epsilon(1e-3));
  CHECK(red[2] == 0.0f);
}

TEST_CASE("glTF: a coat has the normals of its own map") {
  const Scene scene = SquareOf(
      Extension("KHR_materials_clearcoat",
                "\"clearcoatFactor\":1,\"clearcoatNormalTexture\":{\"index\":0,\"scale\":2}"),
      kTextures);
  const std::optional<TextureStep> node = NodeOf(scene, "clearcoat_normal");
  REQUIRE(node);
  const std::array<float, 3> red = TexelAt(scene.images[node->image], 0, 0, 0);
  CHECK(red[0] == 1.5f);  // slopes of 2 and -2
  CHECK(red[1] == -0.5f);
  CHECK(scene.materials[0].normal_map == kNoTexture);
  CHECK(scene.warnings.empty());
  // By the specification the surface's own map does not count for it.
  const std::string coat = Extension("KHR_materials_clearcoat", "\"clearcoatFactor\":1");
  const Scene smooth = SquareOf("\"normalTexture\":{\"index\":0}," + coat, kTextures);
  CHECK(Value(smooth.materials[0], "clearcoat_normal", 0) == 0.5f);
  CHECK(Value(smooth.materials[0], "clearcoat_normal", 2) == 1.0f);
  CHECK_FALSE(NodeOf(smooth, "clearcoat_normal"));
  CHECK(Value(SquareOf(coat).materials[0], "clearcoat_normal", 2) == 0.5f);
}

TEST_CASE("glTF: tangents are kept of meshes whose materials need them, mirrored with their node") {
  const auto scene_of = [](const std::string& material, const std::string& node,
                           const std::string& attributes = ",\"NORMAL\":3,\"TANGENT\":4") {
    test::GltfData data = test::SquareData();
    data.Floats("VEC3", 3, {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
    data.Floats("VEC4", 4, {0, 1, 0, -1, 0, 2, 0, -1, 1, 0, 0, 1, 0, 0, 0, 1});
    return test::GltfScene(
        data.Json("\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1" +
                  attributes + "},\"indices\":2,\"material\":0}]}],\"nodes\":[{\"mesh\":0" + node +
                  "}],\"materials\":[{" + material + "}]," + kTextures));
  };
  const std::string map = "\"normalTexture\":" + kTexture0;
  const std::string brushed = Extension("KHR_materials_anisotropy", "\"anisotropyStrength\":0.5");
  const std::string coated = Extension(
      "KHR_materials_clearcoat", "\"clearcoatFactor\":1,\"clearcoatNormalTexture\":" + kTexture0);
  for (const std::string& material : {map, brushed, coated}) {
    const Scene scene = scene_of(material, "");
    CHECK(scene.tangents == std::vector<float>{0, 1, 0, -1, 0, 1, 0, -1, 1, 0, 0, 1, 0, 0, 0, 1});
    CHECK(scene.shapes[0].tangent_offset == 0);
  }
  const Scene plain = scene_of(kPbr + "{\"baseColorTexture\":" + kTexture0 + "}", "");
  CHECK(plain.tangents.empty());
  CHECK(plain.shapes[0].tangent_offset == kNone);
  const Scene mirrored = scene_of(map, ",\"scale\":[1,-3,1]");
  CHECK(std::vector<float>(mirrored.tangents.begin(), mirrored.tangents.begin() + 4) ==
        std::vector<float>{0, -1, 0, 1});
  // By the specification they count with normals only.
  CHECK(scene_of(map, "", ",\"TANGENT\":4").tangents.empty());
}

}  // namespace swell
