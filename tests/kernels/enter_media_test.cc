// Rays that leave surfaces: the medium is that of the side to which they go, on every target.
#include "kernels/enter_media.h"

#include <doctest/doctest.h>

#include <random>
#include <vector>

#include "src/wave/table.h"
#include "tests/support/for_each_target.h"
#include "tests/support/scene_builder.h"

namespace swell::test {
namespace {

// Level rectangles at z = 0, 1, 2: media 1 below and 2 above the first, none at the second, 3 below
// the third, whose normal looks down.
struct Sheets {
  explicit Sheets(size_t count)
      : rays(count), hits(count), leaving(count), rows(count + kRowPadding) {
    for (float z : {0.0f, 1.0f, 2.0f}) builder.AddRectangle({0, 0, z}, {1, 0, 0}, {0, 1, 0});
    for (int i = 0; i < 4; ++i) builder.scene.media.push_back({});
    Shape* shapes = builder.scene.shapes.data();
    shapes[0].inside = 1;
    shapes[0].outside = 2;
    shapes[2].outside = 3;
    shapes[2].record.flags |= kShapeFlipNormal;
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(0.1f, 0.4f);
    const RaysOut r = rays.Columns();
    const RaysOut out = leaving.Columns();
    const HitsOut h = hits.Columns();
    for (size_t i = 0; i < count; ++i) {
      const uint32_t sheet = i % 4;
      rows[i] = static_cast<uint32_t>(count - 1 - i);
      r.dir.x[i] = r.dir.y[i] = 0;
      r.dir.z[i] = -1;
      h.t[i] = 5.0f - float(sheet);
      h.prim[i] = sheet == 3 ? kNoPrim : 2 * sheet;
      h.instance[i] = kNone;
      h.u[i] = h.v[i] = uniform(random);
      r.org.x[i] = h.u[i] + h.v[i];
      r.org.y[i] = h.v[i];
      r.org.z[i] = 5;
      out.path[i] = static_cast<uint32_t>(i);
      out.dir.x[i] = 0.5f;
      out.dir.y[i] = 0.0f;
      out.dir.z[i] = random() % 2 == 0 ? 0.5f : -0.5f;
    }
  }

  static uint32_t Expected(size_t hit_row, bool up, uint32_t before) {
    if (hit_row % 4 == 0) return up ? 2 : 1;
    if (hit_row % 4 == 2) return up ? kVacuum : 3;
    return before;
  }

  SceneBuilder builder;
  Table<RayFields> rays;
  Table<HitFields> hits;
  Table<RayFields> leaving;
  std::vector<uint32_t> rows;
};

}  // namespace

TEST_CASE("EnterMedia: the side to which light leaves says the medium, else it keeps its own") {
  for (const size_t count : kRowCounts) {
    const Sheets sheets(count);
    const SceneTables tables = FinishScene(sheets.builder.scene);
    REQUIRE(tables.media.view.absorption != nullptr);
    ForEachTarget([&](const char* target, Width width) {
      CAPTURE(target);
      CAPTURE(count);
      const std::vector<uint32_t> before(count + kRowPadding, 9);
      std::vector<uint32_t> after(count + kRowPadding), straight(after);
      const RaysIn rays = sheets.rays.ReadColumns(), out = sheets.leaving.ReadColumns();
      EnterMediaArgs args{&tables.view,
                          tables.media.view.surfaces,
                          rays.org,
                          rays.dir,
                          sheets.hits.ReadColumns(),
                          sheets.rows.data(),
                          out.path,
                          out.dir,
                          before.data(),
                          count,
                          after.data()};
      EnterMedia(width, args);
      args.path = nullptr;
      args.leaving = {};
      args.before = nullptr;
      args.after = straight.data();
      EnterMedia(width, args);
      for (size_t i = 0; i < count; ++i) {
        CAPTURE(i);
        const size_t row = count - 1 - i;
        CHECK(after[i] == Sheets::Expected(row, out.dir.z[i] > 0.0f, 9));
        CHECK(straight[i] == Sheets::Expected(row, false, kKeptMedium));
      }
    });
  }
}

TEST_CASE("EnterMedia: borders divide media for rays that pass, and for no others") {
  Sheets sheets(4);
  sheets.builder.scene.shapes[0].border = true;
  const SceneTables tables = FinishScene(sheets.builder.scene);
  CHECK(tables.media.view.any_border);
  const RaysIn rays = sheets.rays.ReadColumns();
  uint32_t after[kRowPadding + 4];
  EnterMediaArgs args{&tables.view,
                      tables.media.view.surfaces,
                      rays.org,
                      rays.dir,
                      sheets.hits.ReadColumns(),
                      sheets.rows.data(),
                      nullptr,
                      {},
                      nullptr,
                      4,
                      after};
  EnterMedia(Width::kWide, args);
  CHECK(after[3] == kKeptMedium);  // rows come backwards
  CHECK(after[1] == 3);
  args.sides = tables.media.view.borders;
  EnterMedia(Width::kWide, args);
  CHECK(after[3] == 1);
  CHECK(after[1] == kKeptMedium);
}

TEST_CASE("media: a scene whose shapes have none has no tables of them") {
  SceneBuilder builder;
  builder.AddRectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  builder.scene.media.push_back({});
  builder.scene.shapes[0].inside = builder.scene.shapes[0].outside = 1;
  CHECK(FinishScene(builder.scene).media.view.absorption == nullptr);
}

}  // namespace swell::test
