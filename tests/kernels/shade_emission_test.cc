// Rays and their hits in, emitted radiance on their paths out.
#include "kernels/shade_emission.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "src/wave/table.h"
#include "tests/reference/solid_angle.h"
#include "tests/support/for_each_target.h"
#include "tests/support/probe.h"
#include "tests/support/scene_builder.h"

namespace swell::test {
namespace {

// Panels in the plane z = 0 under vertical rays: dark, one-sided up, one-sided down, two-sided;
// then a ball that emits and one that does not, met at their poles.
Scene Panels() {
  SceneBuilder builder;
  for (int k = 0; k < 4; ++k) {
    Shape& shape = builder.AddRectangle({4.0f * float(k), 0, 0}, {2, 0, 0}, {0, 2, 0});
    if (k > 0) Emit(shape, float(4 * k), k == 3);
    if (k == 2) shape.record.flags = kShapeFlipNormal;
  }
  Emit(builder.AddSphere(Ball(1, 20, 0, 0)), 16);
  builder.AddSphere(Ball(1, 30, 0, 0));
  return builder.scene;
}

TEST_CASE("ShadeEmission: adds radiance times the MIS weight where the side that is met emits") {
  const Scene scene = Panels();
  const SceneTables tables = FinishScene(scene, LightSampler::kPower);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(0, 1);
  for (size_t count : kRowCounts) {
    ForEachTarget([&](const char* target, Width width) {
      INFO(std::string(target), ", one lane: ", width == Width::kOneLane, ", rows: ", count);
      Table<RayFields> rays(count);
      Table<HitFields> hits(count);
      Table<PathFields> paths(count);
      const RaysOut r = rays.Columns();
      const HitsOut h = hits.Columns();
      const PathsOut p = paths.Columns();
      std::fill_n(h.prim, hits.capacity(), 0xF0000000u);
      std::vector<double> expected(count, 0.125);
      for (size_t i = 0; i < count; ++i) {
        const uint32_t prim = uint32_t(random() % 11);
        const bool miss = prim == 10, sphere = prim >= 8, down = random() % 2 != 0;
        const float height = 1.5f + uniform(random);
        h.prim[i] = miss ? kNoPrim : prim;
        h.t[i] = sphere ? height - 1 : height;
        h.u[i] = h.v[i] = sphere ? 0.0f : 0.25f;
        r.org.x[i] = sphere ? (prim == 8 ? 20.0f : 30.0f) : 4 * float(prim / 2) + 1;
        r.org.y[i] = sphere ? 0.0f : 0.5f;
        r.org.z[i] = down ? height : -height;
        r.dir.z[i] = down ? -1.0f : 1.0f;
        r.throughput.r[i] = r.throughput.g[i] = r.throughput.b[i] = uniform(random);
        r.bsdf_pdf[i] = uniform(random) + 1e-3f;
        r.state[i] = random() % 3 == 0 ? kSpecularRay : 2u;
        r.path[i] = uint32_t(count - 1 - i);
        p.radiance.r[i] = p.radiance.g[i] = p.radiance.b[i] = 0.125f;
        const uint32_t panel = prim / 2;
        const bool shines = !miss && (prim == 8 || (panel == 1 && down) || (panel == 2 && !down) ||
                                      (panel == 3 && !sphere));
        if (!shines) continue;
        const uint32_t light = prim - 2;  // lights are made in the order of primitives
        REQUIRE(tables.lights[light].prim == prim);
        const reference::Vector org{r.org.x[i], r.org.y[i], r.org.z[i]};
        double pdf = double(1 / reference::SolidAngle(org, tables.lights[light]));
        if (sphere) pdf = 1 / (2 * std::numbers::pi * (1 - std::sqrt(1 - 1.0 / (height * height))));
        pdf *= tables.lights[light].select_pdf;
        const double other = r.bsdf_pdf[i];
        const double weight =
            (r.state[i] & kSpecularRay) != 0 ? 1 : other * other / (other * other + pdf * pdf);
        expected[count - 1 - i] += weight * r.throughput.r[i] * (sphere ? 16 : 4 * panel);
      }
      ShadeEmission(width, tables.view, rays.ReadColumns(), hits.ReadColumns(), count, p.radiance);
      for (size_t i = 0; i < count; ++i) {
        REQUIRE(p.radiance.r[i] == doctest::Approx(expected[i]).epsilon(1e-5));
        REQUIRE(p.radiance.g[i] ==
                doctest::Approx(0.125 + (expected[i] - 0.125) / 2).epsilon(1e-5));
        REQUIRE(p.radiance.b[i] ==
                doctest::Approx(0.125 + (expected[i] - 0.125) / 4).epsilon(1e-5));
      }
    });
  }
}

// A panel under the origin that emits a picture of two texels, 0.25 and 0.75, which it sees at
// (u, 0.5) and, by its second coordinates, at (1 - u, 0.5).
Scene PicturedPanel(const SurfaceLookup& lookup, float u) {
  SceneBuilder builder;
  Shape& panel = builder.AddRectangle({-1, -1, -2}, {2, 0, 0}, {0, 2, 0});
  Emit(panel, 4, /*two_sided=*/true);
  panel.record.uv_offset = 0;
  panel.second_uv_offset = 4;
  panel.emission_image = 0;
  for (const float value : {u, u, u, u, 1 - u, 1 - u, 1 - u, 1 - u}) {
    builder.scene.uvs.insert(builder.scene.uvs.end(), {value, 0.5f});
  }
  ImageLight light;
  light.mapping = ImageMapping::kSurface;
  light.lookup = lookup;
  light.image =
      MakeTexelImage({2, 1, 1, TexelFormat::kFloat, {}, {0.25f, 0.75f}, {}}, Levels::kOne);
  builder.scene.image_lights = {light};
  return builder.scene;
}

TEST_CASE("surfaces that emit an image look it up as it says, seen and sampled alike") {
  using Wrap = TextureWrap;
  struct Case {
    SurfaceLookup lookup;
    float u, texel;
  };
  const Case cases[] = {
      {{}, 1.25f, 0.75f},  // as pbrt: the edge goes on
      {{Wrap::kRepeat}, 1.25f, 0.25f},
      {{Wrap::kRepeat}, -0.25f, 0.75f},
      {{Wrap::kRepeat}, 0.5f, 0.5f},  // between the two
      {{Wrap::kRepeat, Wrap::kClamp, TextureFilter::kPoint}, 0.49f, 0.25f},
      {{Wrap::kClamp, Wrap::kRepeat}, -0.25f, 0.25f},
      {{Wrap::kMirror}, 1.25f, 0.75f},
      {{Wrap::kMirror}, -0.75f, 0.75f},
      {{Wrap::kClamp, Wrap::kClamp, TextureFilter::kBilinear, 1}, 0.25f, 0.75f},
  };
  for (const Case& one : cases) {
    const Scene scene = PicturedPanel(one.lookup, one.u);
    const SceneTables tables = FinishScene(scene, LightSampler::kPower);
    WordColumns in(6, 16);
    for (size_t i = 0; i < in.count(); ++i) {
      for (size_t c = 3; c < 6; ++c) in.Set(c, i, 0.05f * float(i) + 0.1f);
    }
    ForEachTarget([&](const char* target, Width width) {
      INFO(std::string(target), ", one lane: ", width == Width::kOneLane, ", u ", one.u);
      const WordColumns sample = RunProbe(ProbeSampleLight, width, in, 12, &tables.view);
      Table<RayFields> rays(1);
      Table<HitFields> hits(1);
      Table<PathFields> paths(1);
      rays.Columns().dir.z[0] = -1;
      rays.Columns().throughput.r[0] = 1;
      rays.Columns().state[0] = kSpecularRay;
      hits.Columns().t[0] = 2;
      hits.Columns().u[0] = hits.Columns().v[0] = 0.25f;
      std::fill_n(hits.Columns().prim, hits.capacity(), 0u);
      ShadeEmission(width, tables.view, rays.ReadColumns(), hits.ReadColumns(), 1,
                    paths.Columns().radiance);
      CHECK(paths.Columns().radiance.r[0] == doctest::Approx(4 * one.texel).epsilon(1e-5));
      for (size_t i = 0; i < in.count(); ++i) {
        CHECK(sample.Float(6, i) == doctest::Approx(4 * one.texel).epsilon(1e-5));
      }
    });
  }
}

}  // namespace
}  // namespace swell::test
