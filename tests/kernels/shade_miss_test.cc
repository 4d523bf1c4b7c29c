// Rays that left the scene in, background radiance on their paths out.
#include "kernels/shade_miss.h"

#include <doctest/doctest.h>

#include <numbers>
#include <random>
#include <vector>

#include "src/wave/table.h"
#include "tests/support/for_each_target.h"

namespace swell::test {
namespace {

TEST_CASE("ShadeMiss: adds each sky times its MIS weight to the listed rows' paths alone") {
  SceneView scene{};
  const float background[3] = {0.5f, 2, 3};
  LightRecord skies[3]{};
  for (LightRecord& sky : skies) {
    sky.type = kInfiniteLight;
    sky.select_pdf = 0.35f;
    for (int c = 0; c < 3; ++c) sky.radiance[c] = background[c] / 2;
  }
  const uint32_t infinite[] = {0, 2};  // the light between is none
  scene.lights.records = skies;
  scene.lights.infinite = infinite;
  scene.lights.infinite_count = 2;
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(0, 1);
  for (size_t count : kRowCounts) {
    ForEachTarget([&](const char* target, Width width) {
      INFO(std::string(target), ", one lane: ", width == Width::kOneLane, ", rows: ", count);
      const size_t rays = 2 * count + 1;
      Table<RayFields> table(rays);
      Table<PathFields> paths(rays);
      const RaysOut r = table.Columns();
      const PathsOut p = paths.Columns();
      for (size_t i = 0; i < rays; ++i) {
        r.path[i] = uint32_t(rays - 1 - i);
        r.state[i] = random() % 2 != 0 ? kSpecularRay | 1u : 3u;
        r.dir.x[i] = r.dir.y[i] = 0;
        r.dir.z[i] = 1;
        r.bsdf_pdf[i] = 2 * uniform(random) + 1e-3f;
        r.throughput.r[i] = uniform(random);
        r.throughput.g[i] = uniform(random);
        r.throughput.b[i] = uniform(random);
        p.radiance.r[i] = p.radiance.g[i] = p.radiance.b[i] = 0.25f;
      }
      std::vector<uint32_t> rows(RoundUpToPadding(count) + kRowPadding, 0xF0000000u);
      for (size_t i = 0; i < count; ++i) rows[i] = uint32_t(2 * i + 1);
      ShadeMiss(width, scene, table.ReadColumns(), rows.data(), count, p.radiance);
      for (size_t i = 0; i < rays; ++i) {
        double weight = 0;
        if (i % 2 != 0) {
          const double pdf = r.bsdf_pdf[i], light = 0.35f / (4 * std::numbers::pi);
          weight = (r.state[i] & kSpecularRay) != 0 ? 1 : pdf * pdf / (pdf * pdf + light * light);
        }
        const uint32_t path = r.path[i];
        REQUIRE(p.radiance.r[path] ==
                doctest::Approx(0.25 + weight * r.throughput.r[i] * 0.5).epsilon(1e-6));
        REQUIRE(p.radiance.g[path] ==
                doctest::Approx(0.25 + weight * r.throughput.g[i] * 2).epsilon(1e-6));
        REQUIRE(p.radiance.b[path] ==
                doctest::Approx(0.25 + weight * r.throughput.b[i] * 3).epsilon(1e-6));
      }
    });
  }
}

}  // namespace
}  // namespace swell::test
