// glTF materials: factors and textures as parameters, opacity, emission, and what is told of.
#include <array>
#include <cmath>
#include <optional>

#include "kernels/material.h"
#include "tests/import/gltf_texts.h"

namespace swell {
namespace {

using test::CountWarnings;
using test::kTextures;
using test::SquareOf;

const std::string kPbr = "\"pbrMetallicRoughness\":";
const std::string kTexture0 = "{\"index\":0}";

std::string Extension(const std::string& name, const std::string& members) {
  return "\"extensions\":{\"" + name + "\":{" + members + "}}";
}

uint32_t WordOf(const Material& material, std::string_view name) {
  const MaterialInfo& info = *kMaterialKinds[material.kind];
  for (uint32_t i = 0; i < info.param_count; ++i) {
    if (name == info.params[i].name) return ParamOffset(info, i);
  }
  FAIL("no parameter " << std::string(name));
  return 0;
}
float Value(const Material& material, std::string_view name, uint32_t channel = 0) {
  return material.params[WordOf(material, name) + channel];
}
std::string KindOf(const Material& material) { return kMaterialKinds[material.kind]->name; }

// The node that gives a parameter, if a texture does.
std::optional<TextureStep> NodeOf(const Scene& scene, std::string_view name) {
  const Material& material = scene.materials[0];
  for (const MaterialTexture& texture : material.textures) {
    if (texture.word == WordOf(material, name)) return scene.texture_nodes[texture.node];
  }
  return std::nullopt;
}

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

TEST_CASE("glTF: what is not supported of materials is told once for each kind") {
  const auto check = [](const std::string& name, const std::string& members,
                        std::string_view fragment) {
    CHECK(CountWarnings(SquareOf(Extension(name, members), kTextures), fragment) == 1);
  };
  check("KHR_materials_iridescence", "\"iridescenceFactor\":1", "KHR_materials_iridescence");
  check("KHR_materials_dispersion", "\"dispersion\":1", "KHR_materials_dispersion");
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
