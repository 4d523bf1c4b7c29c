// Scenes with many lights and points among them in, claims about which lights are drawn out.
#include "kernels/choose_lights.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <vector>

#include "src/wave/table.h"
#include "tests/support/probe.h"
#include "tests/support/scene_builder.h"

namespace swell::test {
namespace {

using reference::Vector;

// Triangles, spheres, points, spots and, if `distant`, two skies and a sun, all within 10 units.
Scene ManyLights(uint32_t count, bool distant, uint32_t seed = 1) {
  std::mt19937 random(seed);
  const auto uniform = [&](float low, float high) {
    return low + (high - low) * (float(random() >> 8) * 0x1p-24f);
  };
  SceneBuilder builder;
  for (uint32_t i = 0; i < count; ++i) {
    const float x = uniform(-5, 5), y = uniform(-5, 5), z = uniform(-5, 5), level = uniform(0, 9);
    if (i % 4 == 0) {
      const auto edge = [&] { return uniform(-0.3f, 0.3f); };
      Emit(builder.AddMesh(
               {x, y, z, x + edge(), y + edge(), z + edge(), x + edge(), y + edge(), z + edge()},
               {0, 1, 2}),
           level, i % 8 == 0);
    } else if (i % 4 == 1) {
      builder.AddLight(kPointLight, {level, level, level}, {x, y, z});
    } else if (i % 4 == 2) {
      LightRecord& spot = builder.AddLight(kSpotLight, {level, level, level}, {x, y, z});
      const Vector n = reference::Normalize({uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)});
      spot.n[0] = float(n.x), spot.n[1] = float(n.y), spot.n[2] = float(n.z);
      spot.e1[0] = 0.9f, spot.e1[1] = 0.6f;
    }
  }
  for (uint32_t i = 3; i < count; i += 4) {
    Emit(builder.AddSphere(Ball(uniform(0.01f, 0.5f), uniform(-5, 5), uniform(-5, 5), 2)), 3);
  }
  if (distant) {
    builder.AddLight(kInfiniteLight, {1, 1, 1});
    builder.AddLight(kDistantLight, {1, 1, 1}, {0, 0, 1});
    builder.AddLight(kInfiniteLight, {2, 1, 1});
  }
  return builder.scene;
}

// Rows of points that ask, and what they got.
struct Asked {
  explicit Asked(size_t rows) : count(rows), cells(9, std::vector<float>(rows + 2 * kRowPadding)) {
    light.resize(rows + 2 * kRowPadding);
  }
  void Put(size_t i, const Vector& p, const Vector& n, float u) {
    const float values[] = {float(p.x), float(p.y), float(p.z), float(n.x),
                            float(n.y), float(n.z), u};
    for (size_t c = 0; c < 7; ++c) cells[c][i] = values[c];
  }
  ChooseLightsArgs Args(const SceneTables& tables, bool normals) {
    float* n = cells[3].data();
    return {&tables.view.lights,
            count,
            {cells[0].data(), cells[1].data(), cells[2].data()},
            {normals ? n : nullptr, cells[4].data(), cells[5].data()},
            cells[6].data(),
            light.data(),
            cells[7].data()};
  }
  float pdf(size_t i) const { return cells[7][i]; }

  size_t count;
  std::vector<std::vector<float>> cells;
  std::vector<uint32_t> light;
};

Vector RandomPoint(std::mt19937& random, double size) {
  const auto uniform = [&] { return (double(random() >> 8) * 0x1p-24 * 2 - 1) * size; };
  const double x = uniform(), y = uniform(), z = uniform();
  return {x, y, z};
}

constexpr LightSampler kSamplers[] = {LightSampler::kUniform, LightSampler::kPower,
                                      LightSampler::kBvh};

TEST_CASE("ChoicePdfs: sum to 1 over all lights at every point, for every sampler") {
  for (uint32_t count : {1u, 2u, 3u, 17u, 300u}) {
    for (bool distant : {false, true}) {
      const Scene scene = ManyLights(count, distant);
      for (LightSampler sampler : kSamplers) {
        const SceneTables tables = FinishScene(scene, sampler);
        const uint32_t lights = tables.view.lights.count;
        std::mt19937 random(3);
        for (int k = 0; k < 30; ++k) {
          // Among the lights, and far away.
          const Vector p = RandomPoint(random, k % 3 == 0 ? 1000 : 6);
          const Vector n = reference::Normalize(RandomPoint(random, 1));
          Asked asked(lights);
          for (uint32_t i = 0; i < lights; ++i) {
            asked.Put(i, p, n, 0);
            asked.light[i] = i;
          }
          ChoicePdfs(Width::kWide, asked.Args(tables, k % 2 == 0));
          double sum = 0;
          for (uint32_t i = 0; i < lights; ++i) sum += asked.pdf(i);
          INFO("lights: ", lights, ", sampler: ", int(sampler), ", point: ", k);
          CHECK(std::abs(sum - 1) < 1e-5);
        }
      }
    }
  }
}

// Pearson's statistic of the lights that `count` numbers in strata draw at one point, over the
// lights that are expected often; and its mean for independent draws.
TEST_CASE("ChooseLights: draws lights as often as ChoicePdfs says, for every sampler") {
  const Scene scene = ManyLights(60, true);
  constexpr uint32_t kDraws = 1 << 16;
  std::mt19937 random(5);
  for (LightSampler sampler : kSamplers) {
    const SceneTables tables = FinishScene(scene, sampler);
    const uint32_t lights = tables.view.lights.count;
    for (int k = 0; k < 8; ++k) {
      const Vector p = RandomPoint(random, 6);
      const Vector n = reference::Normalize(RandomPoint(random, 1));
      Asked asked(kDraws), all(lights);
      for (uint32_t i = 0; i < kDraws; ++i) asked.Put(i, p, n, float(random() >> 8) * 0x1p-24f);
      for (uint32_t i = 0; i < lights; ++i) {
        all.Put(i, p, n, 0);
        all.light[i] = i;
      }
      ChooseLights(Width::kWide, asked.Args(tables, true));
      ChoicePdfs(Width::kWide, all.Args(tables, true));
      std::vector<uint32_t> drawn(lights);
      for (uint32_t i = 0; i < kDraws; ++i) {
        REQUIRE(asked.light[i] < lights);
        REQUIRE(asked.pdf(i) == doctest::Approx(all.pdf(asked.light[i])).epsilon(1e-6));
        ++drawn[asked.light[i]];
      }
      double statistic = 0, rare = 0;
      uint32_t cells = 0, rarely = 0;
      for (uint32_t i = 0; i < lights; ++i) {
        const double expected = double(all.pdf(i)) * kDraws;
        if (expected < 10) {
          rare += expected;
          rarely += drawn[i];
          continue;
        }
        statistic += (drawn[i] - expected) * (drawn[i] - expected) / expected;
        ++cells;
      }
      INFO("sampler: ", int(sampler), ", point: ", k, ", cells: ", cells);
      REQUIRE(cells > 3);
      // Mean cells - 1, deviation sqrt(2 (cells - 1)); five of them.
      CHECK(statistic < cells - 1 + 5 * std::sqrt(2.0 * (cells - 1)));
      CHECK(std::abs(rarely - rare) < 5 * std::sqrt(rare) + 1);
    }
  }
}

TEST_CASE(
    "ChooseLights: the same lights and probabilities to the bit, for every width and target") {
  const SceneTables tables = FinishScene(ManyLights(300, true), LightSampler::kBvh);
  for (size_t count : {1u, 7u, 16u, 17u, 1000u}) {
    CheckSameBits([&](Width width) {
      std::mt19937 random(7);
      Asked asked(count);
      for (size_t i = 0; i < count; ++i) {
        const Vector p = RandomPoint(random, 6), n = reference::Normalize(RandomPoint(random, 1));
        asked.Put(i, p, n, float(random() >> 8) * 0x1p-24f);
      }
      ChooseLights(width, asked.Args(tables, true));
      std::vector<uint32_t> words(asked.light.begin(), asked.light.begin() + ptrdiff_t(count));
      for (size_t i = 0; i < count; ++i) words.push_back(std::bit_cast<uint32_t>(asked.pdf(i)));
      ChoicePdfs(width, asked.Args(tables, true));
      for (size_t i = 0; i < count; ++i) words.push_back(std::bit_cast<uint32_t>(asked.pdf(i)));
      return words;
    });
  }
}

TEST_CASE("ChoicePdfs: a light that reaches a surface is drawn there") {
  const Scene scene = ManyLights(100, false);
  const SceneTables tables = FinishScene(scene, LightSampler::kBvh);
  const uint32_t lights = tables.view.lights.count;
  std::mt19937 random(9);
  size_t reached = 0, behind = 0;
  for (int k = 0; k < 200; ++k) {
    const Vector p = RandomPoint(random, 6), n = reference::Normalize(RandomPoint(random, 1));
    Asked asked(lights);
    for (uint32_t i = 0; i < lights; ++i) {
      asked.Put(i, p, n, 0);
      asked.light[i] = i;
    }
    ChoicePdfs(Width::kWide, asked.Args(tables, true));
    for (uint32_t i = 0; i < lights; ++i) {
      const LightRecord& light = tables.lights[i];
      const Vector at{light.p[0], light.p[1], light.p[2]};
      const Vector to = reference::Normalize(at - p);
      const auto cosine = reference::Dot(to, n);
      bool reaches = cosine > 0;
      if (light.type == kTriangleLight || light.type == kSpotLight) {
        const auto cos = -reference::Dot(to, {light.n[0], light.n[1], light.n[2]});
        reaches = reaches && (light.type == kSpotLight ? cos > 0.6L : cos > 0);
      }
      reached += reaches;
      if (reaches) CHECK(asked.pdf(i) > 0);
      if (light.type == kPointLight && cosine < -0.1L) behind += asked.pdf(i) == 0;
    }
  }
  CHECK(reached > 1000);
  CHECK(behind > 1000);  // and lights behind a surface mostly are not
}

// Numbers just below 1 go to the last siblings of rows that are not full, and what is hashed into
// their digits, deep in the tree, may round them up.
TEST_CASE("ChooseLights: the largest numbers still draw lights that are there") {
  const size_t rows = 1 << 18;
  for (uint32_t count : {70u, 99u, 300u, 700u}) {
    const SceneTables tables = FinishScene(ManyLights(count, false), LightSampler::kBvh);
    std::mt19937 random(5);
    Asked asked(rows);
    for (size_t i = 0; i < rows; ++i) {
      asked.Put(i, RandomPoint(random, 6), {0, 0, 0}, 0x1.fffffep-1f);
    }
    ChooseLights(Width::kWide, asked.Args(tables, false));
    size_t absent = 0, void_draws = 0;
    for (size_t i = 0; i < rows; ++i) {
      absent += asked.light[i] >= tables.view.lights.count ? 1 : 0;
      void_draws += asked.pdf(i) > 0 ? 0 : 1;
    }
    INFO("lights: ", count);
    CHECK(absent == 0);
    CHECK(void_draws == 0);
  }
}

TEST_CASE("EncodeNormal: every code's normal is near, axes are exact, 0 is no normal") {
  std::mt19937 random(11);
  WordColumns in(3, 100000);
  for (uint32_t i = 0; i < in.count(); ++i) {
    Vector n = reference::Normalize(RandomPoint(random, 1));
    if (i < 6) n = Vector{i % 3 == 0 ? 1.0L : 0, i % 3 == 1 ? 1.0L : 0, i % 3 == 2 ? 1.0L : 0};
    if (i >= 3 && i < 6) n = n * -1;
    Put(in, 0, i, n);
  }
  ForEachTarget([&](const char* target, Width width) {
    INFO(std::string(target), ", one lane: ", width == Width::kOneLane);
    const WordColumns out = RunProbe(ProbeNormalCode, width, in, 4);
    reference::Real worst = 0;
    for (uint32_t i = 0; i < in.count(); ++i) {
      const uint32_t code = out.Word(0, i);
      REQUIRE((code >= 1 && code < 4096));
      const Vector n = At(in, 0, i), decoded = At(out, 1, i);
      const auto sine = reference::Length(reference::Cross(n, decoded));
      REQUIRE(reference::Dot(n, decoded) > 0.9L);
      if (i < 6) REQUIRE(sine < 1e-6L);
      worst = std::max(worst, sine);
    }
    CHECK(worst < 0.068L);
    CHECK(worst > 0.06L);
  });
}

}  // namespace
}  // namespace swell::test
