// Media that absorb, and the shapes that divide them.
#include <array>

#include "tests/import/scene_texts.h"

namespace swell {
namespace {

using Vec = std::array<float, 3>;

constexpr const char* kGreen =
    "MakeNamedMedium \"green\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [2 .5 1] "
    "\"rgb sigma_s\" [0 0 0] \"float scale\" 0.5\n";

Scene Lit(const std::string& text) { return test::WorldOf("LightSource \"infinite\"\n" + text); }

}  // namespace

TEST_CASE("media: a shape has the media of its sides; a use may come before the medium") {
  const Scene scene =
      Lit(std::string("MediumInterface \"green\" \"\" Shape \"sphere\"\n") + kGreen +
          "MediumInterface \"\" \"green\" Shape \"disk\"\n"
          "MediumInterface \"green\" Shape \"sphere\"\n");
  REQUIRE(scene.media.size() == 2);
  CHECK(scene.media[1].name == "green");
  CHECK(scene.media[1].absorption == Vec{1.0f, 0.25f, 0.5f});
  REQUIRE(scene.shapes.size() == 3);
  CHECK(scene.shapes[0].inside == 1);
  CHECK(scene.shapes[0].outside == kVacuum);
  CHECK(scene.shapes[1].inside == kVacuum);
  CHECK(scene.shapes[1].outside == 1);
  CHECK(scene.shapes[2].inside == scene.shapes[2].outside);
  CHECK(scene.warnings.empty());
}

TEST_CASE("media: those that scatter or take nothing are none") {
  const Scene scene =
      Lit("MakeNamedMedium \"fog\" \"string type\" \"homogeneous\"\n"
          "MakeNamedMedium \"clear\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [0 0 0] "
          "\"rgb sigma_s\" [0 0 0]\n"
          "MediumInterface \"fog\" \"clear\" Shape \"sphere\"");
  CHECK(scene.media.size() == 1);
  CHECK(scene.shapes[0].inside == kVacuum);
  CHECK(scene.shapes[0].outside == kVacuum);
}

TEST_CASE("media: the camera stands in the outer one, which lasts into the world") {
  const Scene scene = test::SceneOf(std::string(kGreen) +
                                    "MediumInterface \"\" \"green\" Camera \"perspective\" "
                                    "WorldBegin LightSource \"infinite\" Shape \"sphere\"");
  CHECK(scene.camera.medium == 1);
  CHECK(scene.shapes[0].outside == 1);
}

TEST_CASE("media: an interface is a border where media differ, and nothing where they do not") {
  const Scene scene = Lit(std::string(kGreen) +
                          "Material \"interface\" Shape \"sphere\" \"float radius\" 2\n"
                          "MediumInterface \"green\" \"\" Shape \"sphere\"");
  REQUIRE(scene.shapes.size() == 1);
  CHECK(scene.shapes[0].border);
  REQUIRE(scene.shapes[0].alpha != kNoTexture);
  const TextureStep& alpha = scene.texture_nodes[scene.shapes[0].alpha];
  CHECK(alpha.op == TextureOp::kConstant);
  CHECK(alpha.value[0] == 0.0f);
}

}  // namespace swell
