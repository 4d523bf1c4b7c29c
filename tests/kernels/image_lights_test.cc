// Skies, goniometric and projected pictures in; claims about directions, densities and radiance
// out.
#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "src/scene/environment.h"
#include "tests/kernels/image_probe.h"
#include "tests/support/probe.h"
#include "tests/support/scene_builder.h"

namespace swell::test {
namespace {

using reference::kPi;
using reference::Real;
using reference::Vector;

// A picture with black parts, a bright spot and noise.
TexelImage Picture(uint32_t width, uint32_t height) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(0, 1);
  Pixels pixels{width, height, 3, TexelFormat::kFloat, {}, {}, {}};
  for (size_t i = 0; i < pixels.size(); ++i) {
    const size_t pixel = i / 3;
    const float level = pixel % 5 == 0 ? 0.0f : pixel == width * height / 3 ? 20.0f : 2.0f;
    pixels.values.push_back(level * uniform(random));
  }
  return MakeTexelImage(pixels, Levels::kOne);
}

// Turned, mirrored and stretched evenly.
const std::array<float, 9> kLightFromWorld{0, 0.6f, 0.8f, -1, 0, 0, 0, 0.8f, -0.6f};

ImageLight Sky(ImageMapping mapping) {
  ImageLight sky;
  sky.image = mapping == ImageMapping::kLatLong ? Picture(16, 8) : Picture(12, 12);
  sky.mapping = mapping;
  sky.infinite = true;
  for (size_t i = 0; i < 9; ++i) {
    sky.light_from_world[i] = 0.5f * kLightFromWorld[i];
    sky.world_from_light[i] = 2.0f * kLightFromWorld[i % 3 * 3 + i / 3];
  }
  return sky;
}

SceneBuilder SkyScene(const ImageLight& sky) {
  SceneBuilder builder;
  builder.AddRectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  builder.AddLight(kImageInfiniteLight, {2, 2, 2}).image = 0;
  builder.scene.image_lights = {sky};
  return builder;
}

// The pixel of a world direction, by formulas in long double.
std::pair<uint32_t, uint32_t> PixelOf(const ImageLight& light, const Vector& world) {
  const auto& m = light.light_from_world;
  const Vector w = reference::Normalize({m[0] * world.x + m[1] * world.y + m[2] * world.z,
                                         m[3] * world.x + m[4] * world.y + m[5] * world.z,
                                         m[6] * world.x + m[7] * world.y + m[8] * world.z});
  Real u, v;
  if (light.mapping == ImageMapping::kLatLong) {
    u = std::atan2(w.y, w.x) / (2 * kPi);
    u -= std::floor(u);
    v = std::acos(w.z) / kPi;
  } else {
    const Real r = std::sqrt(1 - std::abs(w.z));
    const Real angle = std::atan2(std::abs(w.y), std::abs(w.x)) * 2 / kPi;
    Real a = r * (1 - angle), b = r * angle;
    if (w.z < 0) {
      const Real folded = 1 - b;
      b = 1 - a;
      a = folded;
    }
    u = (std::copysign(a, w.x) + 1) / 2;
    v = (std::copysign(b, w.y) + 1) / 2;
  }
  const ImageLevel& level = light.image.levels[0];
  return {std::min(uint32_t(u * level.width), level.width - 1),
          std::min(uint32_t(v * level.height), level.height - 1)};
}

Vector RandomDirection(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  const Real z = 1 - 2 * uniform(random), phi = 2 * kPi * uniform(random);
  const Real r = std::sqrt(1 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

WordColumns RandomDirections(size_t count) {
  std::mt19937 random(11);
  WordColumns in(3, count);
  for (size_t i = 0; i < count; ++i) Put(in, 0, i, RandomDirection(random));
  return in;
}

// Samples of a sky by independent numbers.
WordColumns DrawSky(const SceneView& view, Width width, size_t count) {
  std::mt19937 random(5);
  WordColumns in(6, count);
  for (size_t i = 0; i < count; ++i) {
    Put(in, 0, i, {0, 0, 0});
    for (size_t c = 3; c < 6; ++c) in.Set(c, i, float(random() >> 8) * 0x1p-24f);
  }
  return RunProbe(ProbeSampleLight, width, in, 12, &view);
}

}  // namespace

TEST_CASE("sphere maps: there and back, and equal areas") {
  const WordColumns in = RandomDirections(20000);
  ForEachTarget([&](const char* target, Width width) {
    INFO(std::string(target), ", one lane: ", width == Width::kOneLane);
    const WordColumns out = RunProbe(ProbeSphereMaps, width, in, 7);
    size_t counts[16] = {};
    for (size_t i = 0; i < in.count(); ++i) {
      const Vector w = At(in, 0, i);
      REQUIRE(reference::Length(At(out, 2, i) - w) < 2e-6);
      const float u = out.Float(0, i), v = out.Float(1, i);
      REQUIRE((u >= 0 && u <= 1 && v >= 0 && v <= 1));
      ++counts[std::min(int(u * 4), 3) * 4 + std::min(int(v * 4), 3)];
      const Real phi = out.Float(5, i) * 2 * kPi, theta = out.Float(6, i) * kPi;
      const Vector back{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                        std::cos(theta)};
      REQUIRE(reference::Length(back - w) < 4e-6);
    }
    for (size_t count : counts) CHECK(std::abs(double(count) / 1250 - 1) < 0.15);
  });
}

TEST_CASE("sphere maps: the axes of the equal-area square") {
  WordColumns in(3, 6);
  const Vector axes[] = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  const float expected[6][2] = {{0.5f, 0.5f}, {1, 0.5f}, {0.5f, 1}, {0, 0.5f}, {0.5f, 0}, {1, 1}};
  for (size_t i = 0; i < 6; ++i) Put(in, 0, i, axes[i]);
  ForEachTarget([&](const char* target, Width width) {
    INFO(std::string(target));
    const WordColumns out = RunProbe(ProbeSphereMaps, width, in, 7);
    for (size_t i = 0; i < 6; ++i) {
      CHECK(out.Float(0, i) == doctest::Approx(expected[i][0]));
      CHECK(out.Float(1, i) == doctest::Approx(expected[i][1]));
    }
  });
}

TEST_CASE("EvaluateSky: is the image in that direction, and its density integrates to 1") {
  for (ImageMapping mapping : {ImageMapping::kEqualArea, ImageMapping::kLatLong}) {
    const ImageLight sky = Sky(mapping);
    const SceneBuilder builder = SkyScene(sky);
    const SceneTables tables = FinishScene(builder.scene);
    const WordColumns in = RandomDirections(100000);
    ForEachTarget([&](const char* target, Width width) {
      INFO(std::string(target), ", mapping: ", int(mapping));
      const WordColumns out = RunProbe(ProbeSky, width, in, 4, &tables.view);
      size_t wrong = 0;
      double sum = 0;
      for (size_t i = 0; i < in.count(); ++i) {
        const auto [x, y] = PixelOf(sky, At(in, 0, i));
        wrong += out.Float(1, i) != TexelAt(sky.image, 0, x, y)[1];
        sum += out.Float(3, i);
      }
      CHECK(wrong < 10);  // on the borders of pixels
      CHECK(sum / double(in.count()) * 4 * double(kPi) == doctest::Approx(1).epsilon(0.05));
    });
    CheckSameBits(
        [&](Width width) { return RunProbe(ProbeSky, width, in, 4, &tables.view).Rows(); });
  }
}

TEST_CASE("SampleLight: directions to a sky have its density, by Pearson's test over its pixels") {
  for (ImageMapping mapping : {ImageMapping::kEqualArea, ImageMapping::kLatLong}) {
    const ImageLight sky = Sky(mapping);
    const SceneBuilder builder = SkyScene(sky);
    const SceneTables tables = FinishScene(builder.scene);
    const ImageLevel& level = sky.image.levels[0];
    constexpr size_t kCount = 40000;
    ForEachTarget([&](const char* target, Width width) {
      INFO(std::string(target), ", mapping: ", int(mapping));
      const WordColumns samples = DrawSky(tables.view, width, kCount);
      std::vector<double> observed(level.width * level.height), expected(observed.size());
      WordColumns directions(3, kCount);
      for (size_t i = 0; i < kCount; ++i) {
        Put(directions, 0, i, At(samples, 0, i));
        const auto [x, y] = PixelOf(sky, At(samples, 0, i));
        const size_t pixel = y * level.width + x;
        ++observed[pixel];
        REQUIRE(samples.Float(9, i) > 0);
        REQUIRE(samples.Word(10, i) == 1);  // at infinity, not a delta
        expected[pixel] =
            samples.Float(9, i) * PixelSolidAngle(sky.image, mapping, y) * double(kCount);
      }
      double chi2 = 0, cells = 0;
      for (size_t i = 0; i < observed.size(); ++i) {
        if (expected[i] < 5) continue;
        chi2 += (observed[i] - expected[i]) * (observed[i] - expected[i]) / expected[i];
        ++cells;
      }
      CHECK(cells > 20);
      CHECK(chi2 < cells + 5 * std::sqrt(2 * cells));
      // What was drawn is what would be found there.
      const WordColumns seen = RunProbe(ProbeSky, width, directions, 4, &tables.view);
      size_t differs = 0;
      for (size_t i = 0; i < kCount; ++i) {
        differs += std::abs(seen.Float(3, i) / samples.Float(9, i) - 1) > 1e-4 ||
                   2 * seen.Float(0, i) != samples.Float(6, i);
      }
      CHECK(differs < kCount / 500);  // on the borders of pixels
    });
    CheckSameBits([&](Width width) { return DrawSky(tables.view, width, 4096).Rows(); });
  }
}

TEST_CASE("SampleLight: an even sky's image is drawn uniformly") {
  ImageLight sky = Sky(ImageMapping::kLatLong);
  Pixels pixels{16, 8, 1, TexelFormat::kFloat, {}, std::vector<float>(128, 3.0f), {}};
  sky.image = MakeTexelImage(pixels, Levels::kOne);
  const SceneBuilder builder = SkyScene(sky);
  const SceneTables tables = FinishScene(builder.scene);
  ForEachTarget([&](const char* target, Width width) {
    INFO(std::string(target));
    const WordColumns samples = DrawSky(tables.view, width, 1000);
    for (size_t i = 0; i < samples.count(); ++i) {
      REQUIRE(samples.Float(9, i) == doctest::Approx(1 / (4 * double(kPi))).epsilon(1e-4));
      REQUIRE(samples.Float(7, i) == 6.0f);
    }
  });
}

TEST_CASE("SampleLight: spot, goniometric and projection lights fall off as they should") {
  SceneBuilder builder;
  builder.AddRectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  LightRecord& spot = builder.AddLight(kSpotLight, {8, 4, 2}, {1, 2, 3});
  spot.n[2] = -1;
  spot.e1[0] = 0.9f;
  spot.e1[1] = 0.6f;
  LightRecord& gonio = builder.AddLight(kGoniometricLight, {8, 4, 2}, {1, 2, 3});
  gonio.image = 0;
  LightRecord& slide = builder.AddLight(kProjectionLight, {8, 4, 2}, {1, 2, 3});
  slide.image = 1;
  ImageLight beam = Sky(ImageMapping::kEqualArea), projector = beam;
  beam.infinite = projector.infinite = false;
  projector.mapping = ImageMapping::kProjection;
  projector.half_width = {0.8f, 0.5f};
  builder.scene.image_lights = {beam, projector};
  const SceneTables tables = FinishScene(builder.scene, LightSampler::kPower);
  std::mt19937 random(9);
  WordColumns in(6, 30000);
  for (size_t i = 0; i < in.count(); ++i) {
    Put(in, 0, i, Vector{1, 2, 3} + RandomDirection(random) * 2);
    in.Set(3, i, float(random() >> 8) * 0x1p-24f);
    in.Set(4, i, 0.5f);
    in.Set(5, i, 0.5f);
  }
  ForEachTarget([&](const char* target, Width width) {
    INFO(std::string(target), ", one lane: ", width == Width::kOneLane);
    const WordColumns out = RunProbe(ProbeSampleLight, width, in, 12, &tables.view);
    size_t wrong = 0, seen[3] = {}, lit[3] = {};
    for (size_t i = 0; i < in.count(); ++i) {
      const uint32_t which = out.Word(11, i);
      const Vector from = reference::Normalize(At(in, 0, i) - Vector{1, 2, 3});
      Real expected = 0;
      if (which == 0) {
        const Real x = std::min(std::max((-from.z - 0.6L) / 0.3L, 0.0L), 1.0L);
        expected = x * x * (3 - 2 * x);
      } else if (which == 1) {
        const auto [x, y] = PixelOf(beam, from);
        expected = TexelAt(beam.image, 0, x, y)[1];
      } else {
        const auto& m = projector.light_from_world;
        const Vector w{m[0] * from.x + m[1] * from.y + m[2] * from.z,
                       m[3] * from.x + m[4] * from.y + m[5] * from.z,
                       m[6] * from.x + m[7] * from.y + m[8] * from.z};
        const Real u = (w.x / w.z / 0.8L + 1) / 2, v = (w.y / w.z / 0.5L + 1) / 2;
        if (w.z > 0 && u > 0 && u < 1 && v > 0 && v < 1) {
          expected = TexelAt(projector.image, 0, uint32_t(u * 12), uint32_t(v * 12))[1];
        }
      }
      ++seen[which];
      lit[which] += expected > 0;
      wrong += std::abs(out.Float(7, i) - double(expected)) > 1e-4 + 1e-4 * double(expected);
      REQUIRE(out.Word(10, i) == 2);  // a delta
      REQUIRE(out.Float(9, i) == doctest::Approx(tables.lights[which].select_pdf));
    }
    CHECK(wrong < 20);  // on the borders of pixels
    for (size_t which = 0; which < 3; ++which) CHECK((lit[which] > 50 && lit[which] < seen[which]));
  });
}

}  // namespace swell::test
