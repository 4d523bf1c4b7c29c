// Lights: colours, scales, targets, places.
#include <cmath>

#include "tests/import/scene_texts.h"

namespace swell {
namespace {

constexpr double kPi = 3.14159265358979;
constexpr const char* kQuad =
    "Shape \"trianglemesh\" \"point3 P\" [0 0 0  2 0 0  2 3 0  0 3 0] "
    "\"integer indices\" [0 1 2 0 2 3]";

Shape FirstShape(const std::string& text) {
  const Scene scene = test::WorldOf(text);
  REQUIRE(scene.shapes.size() == 1);
  return scene.shapes[0];
}

}  // namespace

TEST_CASE("lights: a point light stands at 'from' in the current space") {
  const Scene scene = test::WorldOf(
      "Translate 1 2 3 Scale 2 2 2 LightSource \"point\" \"rgb I\" [4 5 6] "
      "\"point3 from\" [1 0 0] \"float scale\" 2");
  REQUIRE(scene.lights.size() == 1);
  const LightRecord& light = scene.lights[0];
  CHECK(light.type == kPointLight);
  CHECK(light.p[0] == 3.0f);
  CHECK(light.p[1] == 2.0f);
  CHECK(light.p[2] == 3.0f);
  CHECK(light.radiance[0] == 8.0f);
  CHECK(light.radiance[2] == 12.0f);
  CHECK(light.prim == kNone);
}

TEST_CASE("lights: a point light's power is spread over the sphere of directions") {
  const Scene scene = test::WorldOf("LightSource \"point\" \"float power\" 100");
  CHECK(scene.lights[0].radiance[1] == doctest::Approx(100.0 / (4.0 * kPi)));
}

TEST_CASE("lights: a distant light's direction points at the light and turns with the space") {
  const Scene scene = test::WorldOf(
      "Rotate 90 0 0 1 Scale 5 5 5 LightSource \"distant\" \"rgb L\" [1 2 3] "
      "\"point3 from\" [3 0 0] \"point3 to\" [1 0 0] \"float illuminance\" 10");
  const LightRecord& light = scene.lights[0];
  CHECK(light.type == kDistantLight);
  CHECK(light.p[0] == doctest::Approx(0.0f));
  CHECK(light.p[1] == doctest::Approx(1.0f));
  CHECK(light.p[2] == doctest::Approx(0.0f));
  CHECK(light.radiance[2] == doctest::Approx(30.0f));
}

TEST_CASE("lights: a distant light shines along +z by default") {
  const Scene scene = test::WorldOf("LightSource \"distant\"");
  CHECK(scene.lights[0].p[2] == -1.0f);
  CHECK(scene.lights[0].radiance[0] == 1.0f);
}

TEST_CASE("lights: an area light belongs to the shapes of its attribute block") {
  const Scene scene = test::WorldOf(
      "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [9 8 7] \"bool twosided\" true "
      "\"float scale\" 2 Shape \"sphere\" AttributeEnd Shape \"sphere\"");
  REQUIRE(scene.shapes.size() == 2);
  CHECK(scene.shapes[0].emits);
  CHECK(scene.shapes[0].two_sided);
  CHECK(scene.shapes[0].radiance == std::array<float, 3>{18.0f, 16.0f, 14.0f});
  CHECK(!scene.shapes[1].emits);
  CHECK(scene.lights.empty());
}

TEST_CASE("lights: power sets the radiance by the area in world space") {
  const std::string light = "AreaLightSource \"diffuse\" \"float power\" 10 ";
  // As in pbrt, each of the two triangles has the power.
  CHECK(FirstShape(light + kQuad).radiance[0] == doctest::Approx(10.0 * 2 / (kPi * 6.0)));
  CHECK(FirstShape(light + "Scale 2 2 2 " + kQuad).radiance[0] ==
        doctest::Approx(10.0 * 2 / (kPi * 24.0)));
  CHECK(FirstShape(light + "Shape \"bilinearmesh\" \"point3 P\" [0 0 0 2 0 0 0 3 0 2 3 0]")
            .radiance[0] == doctest::Approx(10.0 / (kPi * 6.0)));
  CHECK(FirstShape(light + "Shape \"disk\" \"float radius\" 2").radiance[0] ==
        doctest::Approx(10.0 / (kPi * kPi * 4.0)));
  CHECK(FirstShape(light + "Shape \"sphere\" \"float radius\" 2").radiance[0] ==
        doctest::Approx(10.0 / (kPi * 16.0 * kPi)));
}

TEST_CASE("lights: a flattened sphere's power counts its ellipsoid's area") {
  // Oblate spheroid of semi-axes 2, 2, 1: 2 pi a^2 (1 + (1 - e^2) / e artanh e).
  const double e = std::sqrt(0.75);
  const double area = 2 * kPi * 4 * (1 + (1 - e * e) / e * std::atanh(e));
  const Shape shape =
      FirstShape("AreaLightSource \"diffuse\" \"float power\" 10 Scale 2 2 1 Shape \"sphere\"");
  CHECK(shape.radiance[0] == doctest::Approx(10.0 / (kPi * area)).epsilon(1e-3));
}

TEST_CASE("lights: a spot light's cone, axis and power") {
  const Scene scene = test::WorldOf(
      "Rotate 90 1 0 0 Scale 3 3 3 LightSource \"spot\" \"point3 from\" [0 1 0] "
      "\"point3 to\" [0 1 2] \"float coneangle\" 60 \"float conedeltaangle\" 30 \"float power\" 5");
  const LightRecord& light = scene.lights.at(0);
  CHECK(light.type == kSpotLight);
  CHECK(light.p[2] == doctest::Approx(3.0f));
  CHECK(light.n[1] == doctest::Approx(-1.0f));
  CHECK(light.e1[0] == doctest::Approx(std::sqrt(0.75)));
  CHECK(light.e1[1] == doctest::Approx(0.5));
  // The cubic's integral over the cosines from 1/2 to sqrt(3/4) is half of their distance.
  const double emitted = 2 * kPi * (1 - std::sqrt(0.75) + (std::sqrt(0.75) - 0.5) / 2);
  CHECK(light.radiance[0] == doctest::Approx(5.0 / emitted));
}

}  // namespace swell
