// Hits of surfaces of known opacity in; how many rays pass, where and how far out.
#include "kernels/pass_alpha.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

#include "src/wave/table.h"
#include "tests/support/probe.h"
#include "tests/support/scene_builder.h"

namespace swell::test {
namespace {

constexpr size_t kCount = 4000;

// Level rectangles at z = 0, 1, 2 of opacity 0.25, 1 (none given) and 0, and rays from z = 5.
struct Sheets {
  SceneBuilder builder;
  Table<RayFields> rays{kCount};
  Table<HitFields> hits{kCount};

  Sheets() {
    for (float z : {0.0f, 1.0f, 2.0f}) builder.AddRectangle({0, 0, z}, {1, 0, 0}, {0, 1, 0});
    for (float alpha : {0.25f, 0.0f}) {
      TextureStep step;
      step.value[0] = alpha;
      builder.scene.texture_nodes.push_back(step);
    }
    builder.scene.shapes[0].alpha = 0;
    builder.scene.shapes[2].alpha = 1;
    std::mt19937 random(6);
    std::uniform_real_distribution<float> uniform(0.1f, 0.4f);
    const RaysOut r = rays.Columns();
    const HitsOut h = hits.Columns();
    for (size_t i = 0; i < kCount; ++i) {
      const uint32_t sheet = i % 4;
      r.dir.x[i] = r.dir.y[i] = 0;
      r.dir.z[i] = -2;
      h.t[i] = (5.0f - float(sheet)) / 2;
      h.prim[i] = sheet == 3 ? kNoPrim : 2 * sheet;
      h.u[i] = uniform(random);
      h.v[i] = uniform(random);
      r.org.x[i] = h.u[i] + h.v[i];
      r.org.y[i] = h.v[i];
      r.org.z[i] = 5;
    }
  }
};

struct Passed {
  WordColumns columns{5, kCount};  // through, origin, moved
  size_t count;
};

Passed Run(const Sheets& sheets, const SceneTables& tables, Width width, const float* t_max,
           size_t count = kCount) {
  Passed passed;
  const auto words = passed.columns.Pointers();
  const auto floats = [&](size_t c) { return reinterpret_cast<float*>(words[c]); };
  const RaysIn rays = sheets.rays.ReadColumns();
  passed.count = PassAlpha(width, PassAlphaArgs{&tables.view,
                                                {},
                                                rays.org,
                                                rays.dir,
                                                sheets.hits.ReadColumns(),
                                                t_max,
                                                count,
                                                words[0],
                                                {floats(1), floats(2), floats(3)},
                                                floats(4)});
  return passed;
}

}  // namespace

TEST_CASE("PassAlpha: rays pass by one less the opacity, the rest stay; the same on every target") {
  const Sheets sheets;
  const SceneTables tables = FinishScene(sheets.builder.scene);
  std::vector<uint32_t> first;
  ForEachTarget([&](const char* target, Width width) {
    INFO(std::string(target), ", one lane: ", width == Width::kOneLane);
    for (size_t count : kRowCounts) {
      const Passed passed = Run(sheets, tables, width, nullptr, count);
      for (size_t k = 0; k < passed.count; ++k) {
        REQUIRE(passed.columns.Word(0, k) < count);
        REQUIRE((k == 0 || passed.columns.Word(0, k - 1) < passed.columns.Word(0, k)));
      }
    }
    const Passed passed = Run(sheets, tables, width, nullptr);
    size_t through[3] = {};
    for (size_t k = 0; k < passed.count; ++k) {
      const uint32_t row = passed.columns.Word(0, k), sheet = row % 4;
      REQUIRE(sheet != 3);
      ++through[sheet];
      const float z = passed.columns.Float(3, k);
      REQUIRE((z < float(sheet) && z > float(sheet) - 1e-4f));
      REQUIRE(passed.columns.Float(4, k) == doctest::Approx((5 - double(z)) / 2).epsilon(1e-6));
      REQUIRE(passed.columns.Float(1, k) ==
              doctest::Approx(sheets.rays.ReadColumns().org.x[row]).epsilon(1e-5));
    }
    CHECK(std::abs(double(through[0]) / 1000 - 0.75) < 4 * std::sqrt(0.75 * 0.25 / 1000));
    CHECK(through[1] == 0);
    CHECK(through[2] == 1000);
    std::vector<uint32_t> rows;
    for (size_t k = 0; k < passed.count; ++k) rows.push_back(passed.columns.Word(0, k));
    if (first.empty()) first = rows;
    CHECK((rows == first));
  });
}

TEST_CASE("PassAlpha: hits beyond t_max are nobody's concern") {
  const Sheets sheets;
  const SceneTables tables = FinishScene(sheets.builder.scene);
  const std::vector<float> t_max(kCount + kRowPadding, 1.8f);  // z = 2 is nearer, z = 0 is not
  ForEachTarget([&](const char* target, Width width) {
    INFO(std::string(target));
    const Passed passed = Run(sheets, tables, width, t_max.data());
    CHECK(passed.count == 1000);
    for (size_t k = 0; k < passed.count; ++k) REQUIRE(passed.columns.Word(0, k) % 4 == 2);
  });
}

}  // namespace swell::test
