// Lights that are images: their mapping, space and targets, and files that cannot be lights.
#include <cmath>
#include <cstring>
#include <limits>

#include "tests/import/scene_texts.h"

namespace swell {
namespace {

constexpr double kPi = 3.14159265358979;

// A portable float map, which has its last row first.
std::string Pfm(uint32_t width, uint32_t height, const std::vector<float>& rgb) {
  std::string text = "PF\n" + std::to_string(width) + " " + std::to_string(height) + "\n-1.0\n";
  for (uint32_t y = height; y-- > 0;) {
    text.append(reinterpret_cast<const char*>(&rgb[size_t{3} * y * width]), size_t{12} * width);
  }
  return text;
}

std::vector<float> Even(size_t pixels, float level) {
  return std::vector<float>(3 * pixels, level);
}

Result<Scene> ReadWith(const std::string& image, const std::string& light) {
  const test::TemporaryFolder folder;
  folder.Write("sky.pfm", image);
  return ImportScene({folder.Write("scene.pbrt", "WorldBegin\n" + light)});
}

Scene SceneWith(const std::string& image, const std::string& light) {
  Result<Scene> scene = ReadWith(image, light);
  INFO((scene ? "" : scene.error().message));
  REQUIRE(scene);
  return std::move(*scene);
}

bool Fails(const std::string& image, const std::string& light, const std::string& fragment) {
  const Result<Scene> scene = ReadWith(image, light);
  if (scene) return false;
  INFO(scene.error().message);
  CHECK(scene.error().message.find("scene.pbrt:2: ") != std::string::npos);
  CHECK(scene.error().message.find(fragment) != std::string::npos);
  return true;
}

const std::string kSky = "LightSource \"infinite\" \"string filename\" \"sky.pfm\" ";

}  // namespace

TEST_CASE("image lights: a square is the equal-area map, 2:1 the latitude-longitude map") {
  CHECK(SceneWith(Pfm(4, 4, Even(16, 1)), kSky).image_lights.at(0).mapping ==
        ImageMapping::kEqualArea);
  const Scene scene =
      SceneWith(Pfm(4, 2, Even(8, 1)), "Scale -2 2 2 " + kSky + "\"float scale\" 3");
  const ImageLight& sky = scene.image_lights.at(0);
  CHECK(sky.mapping == ImageMapping::kLatLong);
  CHECK(sky.infinite);
  CHECK(sky.light_from_world[0] == -0.5f);
  CHECK(sky.world_from_light[4] == 2.0f);
  CHECK(scene.lights.at(0).type == kImageInfiniteLight);
  CHECK(scene.lights[0].image == 0);
  CHECK(scene.lights[0].radiance[0] == 3.0f);
}

TEST_CASE("image lights: pixels keep their order from the top") {
  std::vector<float> rgb(3 * 8);
  for (size_t i = 0; i < rgb.size(); ++i) rgb[i] = float(i);
  const Scene scene = SceneWith(Pfm(4, 2, rgb), kSky);
  CHECK(TexelAt(scene.image_lights[0].image, 0, 1, 0) == std::array<float, 3>{3, 4, 5});
  CHECK(TexelAt(scene.image_lights[0].image, 0, 0, 1) == std::array<float, 3>{12, 13, 14});
}

TEST_CASE("image lights: illuminance is that of the upper half, for both maps") {
  for (const auto& [w, h] : {std::pair{64u, 64u}, {128u, 64u}}) {
    const Scene scene =
        SceneWith(Pfm(w, h, Even(size_t{w} * h, 7)), kSky + "\"float illuminance\" 10");
    // An even sky of radiance L gives pi L.
    CHECK(scene.lights[0].radiance[1] * 7 == doctest::Approx(10 / kPi).epsilon(1e-3));
  }
}

TEST_CASE(
    "image lights: of a mesh that emits an image, the triangles around what is lit are lights") {
  // One texel of 3000 is lit, and every triangle covers 29 of them and the ends of two more.
  const uint32_t width = 3000, count = 100, texel = 2015;
  std::vector<float> rgb(size_t{3} * width);
  rgb[size_t{3} * texel + 1] = 1e-30f;
  std::string points, uvs, indices;
  for (uint32_t i = 0; i < count; ++i) {
    const std::string x = std::to_string(i);
    const auto u = [&](double more) { return std::to_string((i + more) / count) + " "; };
    points += x + " 0 0 " + x + " 1 0 " + x + " 0 1 ";
    uvs += u(0.01) + "0 " + u(0.99) + "0.5 " + u(0.01) + "1 ";
    for (uint32_t k = 0; k < 3; ++k) indices += std::to_string(3 * i + k) + " ";
  }
  const Scene scene = SceneWith(Pfm(width, 1, rgb),
                                "AreaLightSource \"diffuse\" \"string filename\" \"sky.pfm\"\n"
                                "Shape \"trianglemesh\" \"point3 P\" [ " +
                                    points + "] \"point2 uv\" [ " + uvs +
                                    "] \"integer indices\" [ " + indices + "] Shape \"sphere\"");
  REQUIRE(scene.shapes.size() == 3);
  CHECK(scene.shapes[0].emits);
  CHECK(scene.shapes[1].emits);  // spheres stay what they are
  CHECK_FALSE(scene.shapes[2].emits);
  REQUIRE(scene.shapes[0].record.prim_count == 1);
  CHECK(scene.positions[3 * size_t{scene.indices[0]}] == texel / 30);
  // All that are dark, in their order.
  CHECK(scene.shapes[2].record.first_prim == 1);
  REQUIRE(scene.shapes[2].record.prim_count == count - 1);
  CHECK(scene.indices[3] == 0);
  CHECK(scene.indices[3 * (count - 1)] == 3 * (count - 1));
  CHECK(scene.prim_shape[0] == 0);
  CHECK(scene.prim_shape[1] == 2);
  CHECK(scene.prim_shape[count - 1] == 2);
  CHECK(scene.prim_shape[count] == 1);
}

TEST_CASE("image lights: power of goniometric and projection lights") {
  const std::string image = Pfm(32, 32, Even(1024, 2));
  const Scene beam = SceneWith(image,
                               "LightSource \"goniometric\" \"string filename\" \"sky.pfm\" "
                               "\"rgb I\" [1 2 1] \"float power\" 100");
  CHECK(beam.lights[0].type == kGoniometricLight);
  CHECK(!beam.image_lights[0].infinite);
  CHECK(beam.lights[0].radiance[0] * 2 == doctest::Approx(100 / (4 * kPi)));
  CHECK(beam.lights[0].radiance[1] == 2 * beam.lights[0].radiance[0]);
  // A square slide at 90 degrees is one face of a cube: a sixth of the sphere.
  const Scene slide = SceneWith(image,
                                "LightSource \"projection\" \"string filename\" \"sky.pfm\" "
                                "\"float fov\" 90 \"float power\" 100");
  CHECK(slide.lights[0].type == kProjectionLight);
  CHECK(slide.lights[0].radiance[0] * 2 == doctest::Approx(100 / (4 * kPi / 6)).epsilon(1e-3));
  CHECK(slide.image_lights[0].half_width[0] == doctest::Approx(1));
}

TEST_CASE("image lights: a goniometric light has its image's middle along y, as pbrt") {
  const Scene scene = SceneWith(Pfm(2, 2, Even(4, 1)),
                                "Translate 1 2 3 LightSource \"goniometric\" "
                                "\"string filename\" \"sky.pfm\"");
  const auto& m = scene.image_lights[0].light_from_world;
  CHECK(m == std::array<float, 9>{1, 0, 0, 0, 0, 1, 0, 1, 0});
  CHECK(scene.lights[0].p[1] == 2.0f);
}

TEST_CASE("image lights: a wide slide spreads its longer side") {
  const Scene scene = SceneWith(Pfm(4, 2, Even(8, 1)),
                                "LightSource \"projection\" \"string filename\" \"sky.pfm\" "
                                "\"float fov\" 90");
  CHECK(scene.image_lights[0].half_width[0] == doctest::Approx(2));
  CHECK(scene.image_lights[0].half_width[1] == doctest::Approx(1));
  CHECK(scene.image_lights[0].light_from_world[4] == -1.0f);
}

TEST_CASE("image lights: what cannot be one is an error with its place") {
  const std::string good = Pfm(4, 4, Even(16, 1));
  CHECK(Fails(good, "LightSource \"infinite\" \"string filename\" \"no.exr\"",
              "'no.exr' is not in the folder"));
  CHECK(Fails(Pfm(3, 2, Even(6, 1)), kSky, "3 x 2 pixels"));
  CHECK(Fails(good.substr(0, good.size() - 20), kSky, "sky.pfm: "));
  CHECK(Fails("not an image", kSky, "sky.pfm: cannot be read"));
  CHECK(Fails("PF\n1000000 1000000\n-1.0\n", kSky, "sky.pfm: "));
  CHECK(Fails(Pfm(1, 1, {1, std::numeric_limits<float>::infinity(), std::nanf("")}), kSky,
              "2 values are not finite"));
  CHECK(Fails(good, kSky + "\"rgb L\" [1 1 1]", "both given"));
  CHECK(Fails(Pfm(2, 2, Even(4, 0)), kSky + "\"float illuminance\" 3", "the image is black"));
  CHECK(Fails(good, "LightSource \"goniometric\"", "\"string filename\" is missing"));
  CHECK(Fails(good, "LightSource \"projection\"", "\"string filename\" is missing"));
  CHECK(Fails(good, "LightSource \"spot\" \"float coneangle\" 5 \"float conedeltaangle\" 9",
              "above \"coneangle\""));
}

}  // namespace swell
