// Materials by the declarations of a registry (fake_materials.cc).
#include "kernels/material.h"
#include "tests/import/scene_texts.h"

namespace swell {
namespace {

Material OnlyMaterial(const std::string& directive) {
  const Scene scene = test::WorldOf("LightSource \"infinite\" " + directive + " Shape \"sphere\"");
  REQUIRE(scene.materials.size() == 1);
  return scene.materials[0];
}

std::array<float, 5> GlassWords(const std::string& parameters) {
  const Material material = OnlyMaterial("Material \"glass\" " + parameters);
  CHECK(material.kind == 1);
  return {material.params[0], material.params[1], material.params[2], material.params[3],
          material.params[4]};
}

}  // namespace

TEST_CASE("materials: the default is diffuse with reflectance 0.5") {
  const Material material = OnlyMaterial("");
  CHECK(material.kind == 0);
  CHECK(material.params[0] == 0.5f);
  CHECK(material.params[2] == 0.5f);
}

TEST_CASE("materials: parameters fill their words in the order of declaration") {
  CHECK(GlassWords("") == std::array<float, 5>{1.5f, 1, 1, 1, 0});
  CHECK(GlassWords("\"float eta\" 1.25 \"rgb tint\" [2 3 4] \"string fresnel\" \"schlick\"") ==
        std::array<float, 5>{1.25f, 2, 3, 4, 1});
}

TEST_CASE("materials: names stand for values") {
  CHECK(GlassWords("\"spectrum eta\" \"water\"")[0] == 1.33f);
  CHECK(GlassWords("\"string eta\" \"diamond\"")[0] == 2.42f);
  CHECK(GlassWords("\"spectrum tint\" \"Cu\"")[2] == 0.9f);
  CHECK(GlassWords("\"spectrum tint\" \"metal-Au-k\"")[1] == 0.1f);
}

TEST_CASE("materials: metals are found by the names that pbrt gives their eta and k") {
  const Scene scene = test::WorldOf(
      "LightSource \"infinite\" Material \"conductor\" \"spectrum eta\" \"metal-Au-eta\" "
      "\"spectrum k\" \"metal-Cu-k\" \"float roughness\" 0.3 Shape \"sphere\"");
  CHECK(scene.materials[0].params[0] == 0.1f);
  CHECK(scene.materials[0].params[3] == 0.2f);
  CHECK(scene.materials[0].params[6] == -1.0f);
  CHECK(test::Warns(scene, "\"float roughness\" is not supported; the surface is rendered smooth"));
}

TEST_CASE("materials: a glass by its name has one index, with a warning") {
  const Scene scene = test::WorldOf(
      "LightSource \"infinite\" Material \"glass\" \"spectrum eta\" \"glass-BK7\" "
      "Shape \"sphere\"");
  CHECK(scene.materials[0].params[0] == 1.52f);
  CHECK(test::Warns(scene, "'glass-BK7' is used with its mean index, without dispersion"));
}

TEST_CASE("materials: a float is a grey colour") {
  CHECK(OnlyMaterial("Material \"diffuse\" \"float reflectance\" 0.25").params[2] == 0.25f);
}

TEST_CASE("materials: named ones may be used before they are defined") {
  const Scene scene = test::WorldOf(
      "LightSource \"infinite\" NamedMaterial \"late\" Shape \"sphere\" "
      "MakeNamedMaterial \"late\" \"string type\" \"glass\" \"float eta\" 2 "
      "MakeNamedMaterial \"other\" \"string type\" \"diffuse\" "
      "NamedMaterial \"other\" Shape \"sphere\" NamedMaterial \"late\" Shape \"sphere\"");
  REQUIRE(scene.materials.size() == 2);
  CHECK(scene.materials[0].name == "late");
  CHECK(scene.materials[0].kind == 1);
  CHECK(scene.materials[0].params[0] == 2.0f);
  CHECK(scene.shapes[0].record.material == 0);
  CHECK(scene.shapes[1].record.material == 1);
  CHECK(scene.shapes[2].record.material == 0);
}

TEST_CASE("materials: equal unnamed ones are one") {
  const Scene scene = test::WorldOf(
      "LightSource \"infinite\" Material \"glass\" Shape \"sphere\" Material \"diffuse\" "
      "Shape \"sphere\" Material \"glass\" \"float eta\" 1.5 Shape \"sphere\"");
  REQUIRE(scene.materials.size() == 2);
  CHECK(scene.shapes[2].record.material == scene.shapes[0].record.material);
}

TEST_CASE("materials: a kind of pbrt that is missing becomes diffuse with its reflectance") {
  const Scene scene = test::WorldOf(
      "LightSource \"infinite\" Material \"coateddiffuse\" \"rgb reflectance\" [.1 .2 .3] "
      "\"float roughness\" 0.1 \"float thicknes\" 1 Shape \"sphere\"");
  CHECK(scene.materials[0].kind == 0);
  CHECK(scene.materials[0].params[1] == 0.2f);
  CHECK(test::Warns(scene, "type 'coateddiffuse' is not supported; diffuse with its reflectance"));
  CHECK(test::Warns(scene, "did you mean 'thickness'?"));
}

TEST_CASE("materials: a mix names two materials, which may be mixes or come later") {
  const Scene scene = test::WorldOf(
      "LightSource \"infinite\" MakeNamedMaterial \"a\" \"string type\" \"diffuse\" "
      "MakeNamedMaterial \"m\" \"string type\" \"mix\" \"string materials\" [\"a\" \"b\"] "
      "\"float amount\" 0.25 NamedMaterial \"m\" Shape \"sphere\" "
      "Material \"mix\" \"string materials\" [\"m\" \"a\"] Shape \"sphere\" "
      "MakeNamedMaterial \"b\" \"string type\" \"diffuse\" \"rgb reflectance\" [1 0 0]");
  REQUIRE(scene.mixes.size() == 2);
  REQUIRE(scene.materials.size() == 2);
  CHECK(scene.shapes[0].record.material == kMixedMaterial);
  CHECK(scene.shapes[1].record.material == (kMixedMaterial | 1u));
  CHECK(scene.mixes[0].materials == std::array<uint32_t, 2>{0, 1});
  CHECK(scene.mixes[0].amount == 0.25f);
  CHECK(scene.mixes[1].materials == std::array<uint32_t, 2>{kMixedMaterial, 0});
  CHECK(scene.mixes[1].amount == 0.5f);
  CHECK(scene.materials[1].params[0] == 1.0f);
}

TEST_CASE("materials: a material that emits makes its shapes lights, unless the file has its own") {
  const Scene scene = test::WorldOf(
      "Material \"glass\" \"rgb emissive\" [1 2 3] \"float emissive_strength\" 2 Shape \"sphere\" "
      "AreaLightSource \"diffuse\" \"rgb L\" [5 5 5] Shape \"sphere\" "
      "AttributeBegin Material \"glass\" AttributeEnd");
  REQUIRE(scene.shapes.size() == 2);
  CHECK(scene.shapes[0].emits);
  CHECK(scene.shapes[0].radiance == std::array<float, 3>{2, 4, 6});
  CHECK(scene.shapes[1].radiance == std::array<float, 3>{5, 5, 5});
}

TEST_CASE("materials: a material that emits may be defined after the shapes that use it") {
  const Scene scene = test::WorldOf(
      "ObjectBegin \"o\" NamedMaterial \"lamp\" Shape \"sphere\" ObjectEnd "
      "NamedMaterial \"lamp\" Shape \"sphere\" "
      "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [5 5 5] Shape \"sphere\" "
      "AttributeEnd ObjectInstance \"o\" "
      "MakeNamedMaterial \"lamp\" \"string type\" \"glass\" \"rgb emissive\" [1 2 3]");
  REQUIRE(scene.shapes.size() == 3);
  CHECK_FALSE(scene.shapes[0].emits);  // of the object
  CHECK(scene.shapes[1].emits);
  CHECK(scene.shapes[1].radiance == std::array<float, 3>{1, 2, 3});
  CHECK(scene.shapes[2].radiance == std::array<float, 3>{5, 5, 5});
}

TEST_CASE("materials: whole numbers are read as such") {
  CHECK(OnlyMaterial("Material \"glass\" \"integer maxdepth\" 7").params[9] == 7.0f);
}

TEST_CASE("materials: an interface surface is left out, with a word only if it should emit") {
  const Scene scene = test::WorldOf(
      "LightSource \"infinite\" Material \"interface\" Shape \"sphere\" "
      "MakeNamedMaterial \"i\" \"string type\" \"interface\" NamedMaterial \"i\" Shape \"sphere\"");
  CHECK(scene.shapes.empty());
  CHECK(!test::Warns(scene, "interface"));
  const Scene lamp = test::WorldOf(
      "LightSource \"infinite\" AreaLightSource \"diffuse\" Material \"interface\" "
      "Shape \"sphere\"");
  CHECK(lamp.shapes.empty());
  CHECK(test::Warns(lamp, "its AreaLightSource is ignored"));
}

TEST_CASE("materials: parameters of pbrt that a kind lacks are warnings") {
  const auto with = [](const std::string& parameters) {
    return test::WorldOf("LightSource \"infinite\" Material \"glass\" " + parameters +
                         " Shape \"sphere\"");
  };
  CHECK(test::Warns(with("\"float roughness\" 0.25"), "rendered smooth"));
  CHECK(with("\"float roughness\" 0 \"bool remaproughness\" false").warnings.empty());
  CHECK(test::Warns(with("\"rgb tnit\" [1 1 1]"), "did you mean 'tint'?"));
}

}  // namespace swell
