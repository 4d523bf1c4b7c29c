// Hits on a diffuse floor under a panel in, shadow rays and continued paths out.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <vector>

#include "kernels/material.h"
#include "src/wave/table.h"
#include "tests/reference/solid_angle.h"
#include "tests/support/probe.h"
#include "tests/support/scene_builder.h"

namespace swell::test {
namespace {

const MaterialInfo& Diffuse() {
  for (uint32_t k = 0; k < kMaterialKindCount; ++k) {
    if (std::strcmp(kMaterialKinds[k]->name, "diffuse") == 0) return *kMaterialKinds[k];
  }
  FAIL("no diffuse material");
  return *kMaterialKinds[0];
}

constexpr float kAlbedo[3] = {0.5f, 0.25f, 0.75f};
constexpr float kThroughput = 0.8f;

// All rays look down on the floor's point (1, 1, 0); row i is sample i of one pixel.
struct Floor {
  Scene scene;
  SceneTables tables;
  Table<RayFields> rays, next;
  Table<HitFields> hits;
  Table<ShadowRayFields> shadow_rays;
  Table<PathFields> paths;
  std::vector<uint32_t> rows;
  size_t count, shadow_count = 0;

  Floor(size_t row_count, uint32_t bounce, Width width, bool light = true)
      : scene(Build(light)),
        tables(FinishScene(scene)),
        rays(row_count),
        next(row_count),
        hits(row_count),
        shadow_rays(row_count),
        paths(row_count),
        rows(RoundUpToPadding(row_count) + kRowPadding, 0xF0000000u),
        count(row_count) {
    const RaysOut r = rays.Columns();
    const HitsOut h = hits.Columns();
    for (size_t i = 0; i < count; ++i) {
      rows[i] = uint32_t(count - 1 - i);
      r.org.x[i] = r.org.y[i] = 1;
      r.org.z[i] = 1;
      r.dir.z[i] = -1;
      r.path[i] = uint32_t((i + 3) % count);
      r.throughput.r[i] = r.throughput.g[i] = r.throughput.b[i] = kThroughput;
      r.eta_scale[i] = 1;
      r.state[i] = bounce;
      h.t[i] = 1;
      h.u[i] = h.v[i] = 0.25f;
      paths.Columns().pixel[r.path[i]] = 7;
      paths.Columns().sample[r.path[i]] = uint32_t(i);
    }
    const PathSettings settings{5, 10, 3, DiffuseSampling::kDisk};
    const float params[kMaterialWords] = {kAlbedo[0], kAlbedo[1], kAlbedo[2]};
    shadow_count = Diffuse().shade(
        width, {&tables.view, settings, params, rows.data(), count, rays.ReadColumns(),
                hits.ReadColumns(), paths.ReadColumns(), next.Columns(), shadow_rays.Columns(), 0});
  }
  static Scene Build(bool light) {
    SceneBuilder builder;
    builder.AddRectangle({0, 0, 0}, {2, 0, 0}, {0, 4, 0});
    if (light) Emit(builder.AddRectangle({1, 1, 2}, {0, 3, 0}, {1, 0, 0}), 5);
    return builder.scene;
  }
  std::vector<uint32_t> Words() const {
    std::vector<uint32_t> words{uint32_t(shadow_count)};
    for (const uint32_t* c : next.Words()) words.insert(words.end(), c, c + count);
    for (const uint32_t* c : shadow_rays.Words()) words.insert(words.end(), c, c + shadow_count);
    return words;
  }
};

// Solid-angle density with which light sampling draws dir, from the floor's point; 0 beside the
// panel.
double LightDensity(const Floor& floor, const double (&dir)[3]) {
  if (dir[2] <= 0) return 0;
  const double x = 2 * dir[0] / dir[2], y = 2 * dir[1] / dir[2];
  if (x < 0 || x > 1 || y < 0 || y > 3) return 0;
  const LightRecord& light = floor.tables.lights[y > 3 * x ? 0 : 1];
  return double(1 / reference::SolidAngle({1, 1, 0}, light)) * light.select_pdf;
}

TEST_CASE("Shade: continued rays carry path, bounce, density and throughput, from the surface") {
  for (size_t count : kRowCounts) {
    ForEachTarget([&](const char* target, Width width) {
      INFO(std::string(target), ", one lane: ", width == Width::kOneLane, ", rows: ", count);
      const Floor floor(count, 1, width);
      const RaysIn next = floor.next.ReadColumns();
      for (size_t i = 0; i < count; ++i) {
        REQUIRE(next.path[i] == floor.rays.ReadColumns().path[floor.rows[i]]);
        REQUIRE(next.state[i] == 2);
        REQUIRE(next.dir.z[i] > 0);
        REQUIRE(std::hypot(next.dir.x[i], next.dir.y[i], next.dir.z[i]) ==
                doctest::Approx(1).epsilon(1e-6));
        REQUIRE(next.bsdf_pdf[i] ==
                doctest::Approx(next.dir.z[i] / std::numbers::pi).epsilon(1e-5));
        REQUIRE(next.org.x[i] == doctest::Approx(1).epsilon(1e-5));
        REQUIRE((next.org.z[i] > 0 && next.org.z[i] < 1e-5f));
        REQUIRE(next.throughput.r[i] == doctest::Approx(kThroughput * kAlbedo[0]).epsilon(1e-6));
        REQUIRE(next.throughput.g[i] == doctest::Approx(kThroughput * kAlbedo[1]).epsilon(1e-6));
        REQUIRE(next.throughput.b[i] == doctest::Approx(kThroughput * kAlbedo[2]).epsilon(1e-6));
      }
      REQUIRE(floor.shadow_count == count);
    });
    CheckSameBits([&](Width width) { return Floor(count, 1, width).Words(); });
    CheckSameBits([&](Width width) { return Floor(count, 7, width).Words(); });
  }
}

TEST_CASE("Shade: shadow rays end on the panel with the power heuristic's share of its light") {
  ForEachTarget([&](const char* target, Width width) {
    INFO(std::string(target), ", one lane: ", width == Width::kOneLane);
    const Floor floor(1000, 0, width);
    const ShadowRaysIn s = floor.shadow_rays.ReadColumns();
    for (size_t i = 0; i < floor.shadow_count; ++i) {
      REQUIRE(s.t_max[i] == 1.0f);
      REQUIRE(s.path[i] == floor.rays.ReadColumns().path[floor.rows[i]]);
      const double end_z = double(s.org.z[i]) + s.dir.z[i];
      // Before the panel by 32 roundings of its distance and of 6, the sum of its two edges'
      // largest components; see ShadowRayEnd. The rest is the coordinates' own rounding.
      const double farthest = std::max({std::abs(s.dir.x[i]), std::abs(s.dir.y[i]), s.dir.z[i]});
      const double margin = 32 * 0x1p-24 * (farthest + 6) + 2e-6;
      REQUIRE((end_z < 2 && end_z > 2 - margin));
      const double length = std::hypot(s.dir.x[i], s.dir.y[i], s.dir.z[i]);
      const double cosine = s.dir.z[i] / length;
      const double pdf = LightDensity(floor, {s.dir.x[i], s.dir.y[i], s.dir.z[i]});
      const double bsdf = cosine / std::numbers::pi;
      const double weight = pdf * pdf / (pdf * pdf + bsdf * bsdf);
      const double expected = weight * kThroughput * kAlbedo[0] * bsdf * 5 / pdf;
      REQUIRE(s.radiance.r[i] == doctest::Approx(expected).epsilon(1e-4));
    }
  });
}

TEST_CASE("Shade: light and BSDF sampling together give the analytic radiance") {
  const Floor floor(1 << 18, 0, Width::kWide);
  double sum = 0, by_light = 0;
  for (size_t i = 0; i < floor.shadow_count; ++i)
    by_light += floor.shadow_rays.ReadColumns().radiance.r[i];
  const RaysIn next = floor.next.ReadColumns();
  for (size_t i = 0; i < floor.count; ++i) {
    const double light = LightDensity(floor, {next.dir.x[i], next.dir.y[i], next.dir.z[i]});
    const double bsdf = next.bsdf_pdf[i];
    if (light > 0) sum += next.throughput.r[i] * 5 * bsdf * bsdf / (bsdf * bsdf + light * light);
  }
  CHECK(sum > 0);
  CHECK(by_light > sum);
  // Corner of a parallel rectangle (Howell, catalog of configuration factors, B-3).
  const double a = 0.5, b = 1.5, ra = std::sqrt(1 + a * a), rb = std::sqrt(1 + b * b);
  const double factor =
      (a / ra * std::atan(b / ra) + b / rb * std::atan(a / rb)) / (2 * std::numbers::pi);
  const double radiance = (sum + by_light) / double(floor.count);
  CHECK(std::abs(radiance / (kThroughput * kAlbedo[0] * 5 * factor) - 1) < 2e-3);
}

TEST_CASE("Shade: roulette starts after its bounce and keeps the mean throughput") {
  for (uint32_t bounce : {0u, 2u, 3u, 9u}) {
    ForEachTarget([&](const char* target, Width width) {
      INFO(std::string(target), ", bounce: ", bounce);
      const Floor floor(1 << 14, bounce, width);
      const RaysIn next = floor.next.ReadColumns();
      double sum = 0;
      size_t alive = 0;
      for (size_t i = 0; i < floor.count; ++i) {
        if ((next.state[i] & kEndedRay) != 0) continue;
        ++alive;
        sum += next.throughput.g[i];
      }
      const double survive = bounce < 3 ? 1 : kThroughput * kAlbedo[2];
      CHECK(std::abs(double(alive) / double(floor.count) - survive) < 2e-3);
      CHECK(std::abs(sum / double(floor.count) / (kThroughput * kAlbedo[1]) - 1) < 5e-3);
    });
  }
}

TEST_CASE("Shade: a scene without lights casts no shadow rays") {
  ForEachTarget([&](const char* target, Width width) {
    INFO(std::string(target));
    CHECK(Floor(17, 0, width, false).shadow_count == 0);
  });
}

}  // namespace
}  // namespace swell::test
