// Spectra to linear sRGB against published chromaticities.
#include "src/import/spectrum.h"

#include "tests/import/scene_texts.h"

namespace swell {
namespace {

constexpr float kPi = 3.14159265f;

double Luminance(const float* rgb) {
  return 0.2126729 * rgb[0] + 0.7151522 * rgb[1] + 0.0721750 * rgb[2];
}

std::array<float, 3> SkyOf(const std::string& parameters) {
  const Scene scene = test::WorldOf("LightSource \"infinite\" " + parameters);
  REQUIRE(scene.lights.size() == 1);
  const float* l = scene.lights[0].radiance;
  return {l[0], l[1], l[2]};
}

// x and y of the CIE 1931 diagram.
std::array<double, 2> Chromaticity(const std::array<float, 3>& rgb) {
  const double x = 0.4124564 * rgb[0] + 0.3575761 * rgb[1] + 0.1804375 * rgb[2];
  const double y = Luminance(rgb.data());
  const double z = 0.0193339 * rgb[0] + 0.1191920 * rgb[1] + 0.9503041 * rgb[2];
  return {x / (x + y + z), y / (x + y + z)};
}

}  // namespace

TEST_CASE("spectrum: black bodies lie on the Planckian locus at luminance 1") {
  // Wyszecki and Stiles, Color Science, table 1(6.5.2).
  const struct {
    double kelvin, x, y;
  } kLocus[] = {{2500, 0.4770, 0.4137},
                {4000, 0.3805, 0.3768},
                {6500, 0.3135, 0.3237},
                {10000, 0.2807, 0.2884}};
  for (const auto& row : kLocus) {
    INFO(row.kelvin);
    const Rgb3 rgb = BlackbodyColor(row.kelvin);
    CHECK(Luminance(rgb.data()) == doctest::Approx(1.0).epsilon(1e-3));
    const auto xy = Chromaticity(rgb);
    CHECK(std::abs(xy[0] - row.x) < 0.004);
    CHECK(std::abs(xy[1] - row.y) < 0.004);
  }
}

TEST_CASE("spectrum: standard illuminant D65 is white and A is reddish, both of luminance 1") {
  const auto d65 = SkyOf("\"spectrum L\" \"stdillum-D65\"");
  for (float channel : d65) CHECK(channel == doctest::Approx(1.0f).epsilon(2e-3));
  const auto a = SkyOf("\"spectrum L\" \"stdillum-A\"");
  CHECK(Luminance(a.data()) == doctest::Approx(1.0).epsilon(1e-3));
  CHECK(Chromaticity(a)[0] == doctest::Approx(0.44758).epsilon(1e-3));
}

TEST_CASE("spectrum: samples of a light count by their shape, not by their height") {
  const auto one = SkyOf("\"spectrum L\" [360 1 830 1]");
  const auto five = SkyOf("\"spectrum L\" [360 5 830 5] \"float scale\" 2");
  CHECK(Luminance(one.data()) == doctest::Approx(1.0).epsilon(1e-3));
  for (size_t c = 0; c < 3; ++c) CHECK(five[c] == doctest::Approx(2 * one[c]));
  const auto xy = Chromaticity(one);  // equal energy: 1/3, 1/3
  CHECK(std::abs(xy[0] - 1.0 / 3.0) < 0.002);
  CHECK(std::abs(xy[1] - 1.0 / 3.0) < 0.002);
}

TEST_CASE("spectrum: a constant reflectance is grey, a long-wave one red") {
  const Scene scene = test::WorldOf(
      "LightSource \"infinite\"\n"
      "Material \"diffuse\" \"spectrum reflectance\" [300 0.25 900 0.25] Shape \"sphere\"\n"
      "Material \"diffuse\" \"spectrum reflectance\" [590 0 610 0.8 900 0.8] Shape \"sphere\"");
  REQUIRE(scene.materials.size() == 2);
  for (size_t c = 0; c < 3; ++c) {
    CHECK(scene.materials[0].params[c] == doctest::Approx(0.25f).epsilon(1e-5));
  }
  const auto& red = scene.materials[1].params;
  CHECK(red[0] > 0.5f);
  CHECK(red[1] < 0.1f);
  CHECK(red[2] < 0.1f);
}

TEST_CASE("spectrum: files of samples are found beside the scene") {
  const test::TemporaryFolder folder;
  folder.Write("spd/flat.spd", "# nm value\n300 0.125\n900 0.125\n");
  const auto scene =
      ImportScene({folder.Write("a.pbrt",
                                "WorldBegin LightSource \"infinite\" Material \"diffuse\" "
                                "\"spectrum reflectance\" \"spd/flat.spd\" Shape \"sphere\"")});
  REQUIRE(scene);
  CHECK(scene->materials[0].params[1] == doctest::Approx(0.125f).epsilon(1e-5));
}

TEST_CASE("spectrum: rgb light values count as they stand") {
  CHECK(SkyOf("\"rgb L\" [1 2 3] \"float scale\" 0.5") == std::array<float, 3>{0.5f, 1.0f, 1.5f});
  const auto lit = SkyOf("\"rgb L\" [1 1 1] \"float illuminance\" 6");
  CHECK(lit[0] == doctest::Approx(6.0f / kPi));
}

}  // namespace swell
