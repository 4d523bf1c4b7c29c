// Attribute, ColorSpace and Option: what they do to the directives that follow.
#include <array>

#include "src/import/color_space.h"
#include "tests/import/scene_texts.h"

namespace swell {
namespace {

using Vec = std::array<float, 3>;

Scene Lit(const std::string& text) { return test::WorldOf("LightSource \"infinite\"\n" + text); }

void CheckNear(const Vec& got, const Vec& expected, double tolerance) {
  for (size_t c = 0; c < 3; ++c) {
    CAPTURE(c);
    CHECK(got[c] == doctest::Approx(expected[c]).epsilon(tolerance));
  }
}

Vec RadianceOf(const Scene& scene) {
  REQUIRE(!scene.lights.empty());
  const float* radiance = scene.lights[0].radiance;
  return {radiance[0], radiance[1], radiance[2]};
}

}  // namespace

TEST_CASE("attributes: defaults count where a directive says nothing, until the block ends") {
  const Scene scene =
      Lit("AttributeBegin Attribute \"shape\" \"float radius\" 3\n"
          "Shape \"sphere\" Shape \"sphere\" \"float radius\" 2 AttributeEnd Shape \"sphere\"");
  REQUIRE(scene.spheres.size() == 3);
  CHECK(scene.spheres[0].object_to_world[0] == 3.0f);
  CHECK(scene.spheres[1].object_to_world[0] == 2.0f);
  CHECK(scene.spheres[2].object_to_world[0] == 1.0f);
  CHECK(scene.warnings.empty());
}

TEST_CASE("attributes: a later default replaces an earlier one of its name, and keeps the others") {
  const Scene scene =
      Lit("Attribute \"shape\" \"float radius\" 3 \"float zmax\" 1\n"
          "Attribute \"shape\" \"float radius\" 5 Shape \"disk\"");
  float furthest = 0.0f;
  for (const float value : scene.positions) furthest = std::max(furthest, value);
  CHECK(furthest == doctest::Approx(5.0f).epsilon(1e-3));
  CHECK(scene.warnings.empty());  // zmax is no parameter of a disk, but nobody gave it to one
}

TEST_CASE("attributes: each kind of directive has its own defaults") {
  const Scene scene = test::SceneOf(
      "Attribute \"light\" \"float scale\" 7 WorldBegin\n"
      "Attribute \"material\" \"rgb reflectance\" [.25 .5 .75] LightSource \"infinite\"\n"
      "AreaLightSource \"diffuse\" Material \"diffuse\" Shape \"sphere\"");
  CHECK(RadianceOf(scene) == Vec{7, 7, 7});
  CHECK(scene.shapes[0].radiance == Vec{7, 7, 7});
  CHECK(scene.materials[0].params[0] == 0.25f);
  CHECK(scene.materials[0].params[2] == 0.75f);
}

TEST_CASE("attributes: a default's textures and media are looked up where it is used") {
  const Scene scene =
      Lit("Attribute \"texture\" \"float scale\" 0.5\n"
          "Attribute \"medium\" \"rgb sigma_s\" [0 0 0]\n"
          "MakeNamedMedium \"a\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [1 2 3]\n"
          "MediumInterface \"a\" \"\" Shape \"sphere\"");
  REQUIRE(scene.media.size() == 2);
  CHECK(scene.media[1].absorption == Vec{1, 2, 3});
}

TEST_CASE("colour spaces: white stays white, as a light's and as a surface's") {
  for (const ColorSpaceName space :
       {ColorSpaceName::kSrgb, ColorSpaceName::kDciP3, ColorSpaceName::kRec2020}) {
    for (const ColorUse use : {ColorUse::kLight, ColorUse::kWeight}) {
      CheckNear(ToSrgb(space, use, {1, 1, 1}), {1, 1, 1}, 1e-5);
    }
  }
  CheckNear(ToSrgb(ColorSpaceName::kAces2065, ColorUse::kWeight, {0.5, 0.5, 0.5}), {0.5, 0.5, 0.5},
            1e-5);
  const Vec d60 = ToSrgb(ColorSpaceName::kAces2065, ColorUse::kLight, {1, 1, 1});
  CHECK(d60[0] > 1.0f);  // warmer than D65
  CHECK(d60[2] < 0.95f);
}

TEST_CASE("colour spaces: the matrices are the published ones") {
  // ITU-R BT.2087-0, annex 1, inverted: BT.2020 to BT.709.
  const Vec green = ToSrgb(ColorSpaceName::kRec2020, ColorUse::kLight, {0.2f, 0.7f, 0.2f});
  CheckNear(green,
            {0.2f * 1.6605f - 0.7f * 0.5876f - 0.2f * 0.0728f > 0
                 ? 0.2f * 1.6605f - 0.7f * 0.5876f - 0.2f * 0.0728f
                 : 0.0f,
             -0.2f * 0.1246f + 0.7f * 1.1329f - 0.2f * 0.0083f,
             -0.2f * 0.0182f - 0.7f * 0.1006f + 0.2f * 1.1187f},
            1e-3);
  const Vec pale = ToSrgb(ColorSpaceName::kRec2020, ColorUse::kLight, {0.6f, 0.5f, 0.4f});
  CheckNear(pale,
            {0.6f * 1.6605f - 0.5f * 0.5876f - 0.4f * 0.0728f,
             -0.6f * 0.1246f + 0.5f * 1.1329f - 0.4f * 0.0083f,
             -0.6f * 0.0182f - 0.5f * 0.1006f + 0.4f * 1.1187f},
            1e-3);
}

TEST_CASE("colour spaces: hold for colours that follow, within their block") {
  const Scene scene = test::WorldOf(
      "AttributeBegin ColorSpace \"rec2020\" LightSource \"infinite\" \"rgb L\" [.6 .5 .4] "
      "AttributeEnd LightSource \"infinite\" \"rgb L\" [.6 .5 .4]\n"
      "ColorSpace \"rec2020\" Material \"diffuse\" \"rgb reflectance\" [1 0 0] Shape \"sphere\"");
  REQUIRE(scene.lights.size() == 2);
  CHECK(scene.lights[0].radiance[0] > 0.65f);
  CHECK(scene.lights[1].radiance[0] == 0.6f);
  // A surface reflects no more than all light.
  CHECK(scene.materials[0].params[0] == 1.0f);
  CHECK(scene.materials[0].params[1] == 0.0f);
}

TEST_CASE("options: the seed, with and without its type; what changes nothing is no warning") {
  CHECK(test::SceneOf("Option \"seed\" 17 WorldBegin").request.seed == 17);
  const Scene scene = test::SceneOf(
      "Option \"integer seed\" 18 Option \"bool disablepixeljitter\" false "
      "Option \"rendercoordsys\" \"world\" WorldBegin LightSource \"infinite\" Shape \"sphere\"");
  CHECK(scene.request.seed == 18);
  CHECK(scene.warnings.empty());
}

}  // namespace swell
