// Lights and points that see them in, claims about drawn directions and densities out.
#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "tests/reference/solid_angle.h"
#include "tests/reference/vector.h"
#include "tests/support/probe.h"
#include "tests/support/scene_builder.h"

namespace swell::test {
namespace {

using reference::kPi;
using reference::Real;
using reference::Vector;

constexpr uint32_t kSide = 128;  // strata of the drawn point, per axis

// kSide^2 samples from p, for each of `selections` strata of the choice of the light.
WordColumns Draw(const SceneView& view, const Vector& p, Width width, uint32_t selections = 1) {
  WordColumns in(6, kSide * kSide * selections);
  for (uint32_t i = 0; i < in.count(); ++i) {
    Put(in, 0, i, p);
    in.Set(3, i, (float(i / (kSide * kSide)) + 0.5f) / float(selections));
    in.Set(4, i, (float(i % kSide) + 0.5f) / kSide);
    in.Set(5, i, (float(i / kSide % kSide) + 0.5f) / kSide);
  }
  return RunProbe(ProbeSampleLight, width, in, 12, &view);
}

// Smooth functions of a direction that tell distributions apart.
const std::function<Real(const Vector&)> kMoments[] = {
    [](const Vector&) { return 1.0L; },
    [](const Vector& w) { return w.x; },
    [](const Vector& w) { return w.y; },
    [](const Vector& w) { return w.z; },
    [](const Vector& w) { return w.x * w.x; },
    [](const Vector& w) { return w.x * w.y; },
    [](const Vector& w) { return w.z * w.z * w.y; },
};

// Integral over the directions in which a surface patch is seen from p: sum of f cos / d^2 dA over
// points of the unit square.
Real Integrate(const Vector& p, const std::function<Real(const Vector&)>& f,
               const std::function<void(Real, Real, Vector&, Vector&, Real&)>& patch) {
  constexpr int kSteps = 400;
  Real sum = 0;
  for (int i = 0; i < kSteps * kSteps; ++i) {
    Vector point, n;
    Real area = 0;
    patch((i % kSteps + 0.5L) / kSteps, (i / kSteps + 0.5L) / kSteps, point, n, area);
    const Vector to = point - p;
    const Real d2 = reference::Dot(to, to);
    const Vector w = to * (1 / std::sqrt(d2));
    const Real cosine = -reference::Dot(n, w);
    if (cosine > 0) sum += f(w) * cosine / d2 * area;
  }
  return sum / (kSteps * kSteps);
}

// Mean of f / pdf over the samples that are not void.
Real Estimate(const WordColumns& samples, const std::function<Real(const Vector&)>& f) {
  Real sum = 0;
  for (size_t i = 0; i < samples.count(); ++i) {
    const Real pdf = samples.Float(9, i);
    if (pdf > 0) sum += f(At(samples, 0, i)) / pdf;
  }
  return sum / Real(samples.count());
}

void CheckDensity(const SceneView& view, const Vector& p,
                  const std::function<void(Real, Real, Vector&, Vector&, Real&)>& patch) {
  std::vector<Real> expected;
  for (const auto& f : kMoments) expected.push_back(Integrate(p, f, patch));
  ForEachTarget([&](const char* target, Width width) {
    INFO(std::string(target), ", one lane: ", width == Width::kOneLane);
    const WordColumns samples = Draw(view, p, width);
    for (size_t k = 0; k < expected.size(); ++k) {
      CAPTURE(k);
      CHECK(std::abs(Estimate(samples, kMoments[k]) - expected[k]) < 2e-3 * expected[0]);
    }
  });
  CheckSameBits([&](Width width) { return Draw(view, p, width).Rows(); });
}

// Points of the ellipsoid `m` by Archimedes' map; `side` -1: seen from inside.
auto SpherePatch(const SphereRecord& sphere, Real side) {
  return [&sphere, side](Real a, Real b, Vector& point, Vector& n, Real& area) {
    const Real z = 1 - 2 * a, r = std::sqrt(1 - z * z), phi = 2 * kPi * b;
    const Vector object{r * std::cos(phi), r * std::sin(phi), z};
    const float* m = sphere.object_to_world;
    point = reference::TransformPoint(m, object);
    n = reference::TransformNormal(sphere.world_to_object, object);
    const Vector x{m[0], m[4], m[8]}, y{m[1], m[5], m[9]}, w{m[2], m[6], m[10]};
    area = 4 * kPi * reference::Length(n) * std::abs(reference::Dot(x, reference::Cross(y, w)));
    n = reference::Normalize(n) * side;
  };
}

const Affine kEllipsoid{1.5f, 0.2f, 0, 1, 0.1f, 0.7f, 0.3f, 2, 0, 0.2f, 1, 5};

TEST_CASE("SampleLight: directions to a triangle have the density it says") {
  for (const Vector& p : {Vector{0, 0, 0}, {0.3L, 0.9L, 2.5L}, {5, 1, 0}}) {
    SceneBuilder builder;
    Emit(builder.AddMesh({0, 0, 3, 1, 2, 3, 2, 0, 3.5f}, {0, 1, 2}), 1);
    const SceneTables tables = FinishScene(builder.scene);
    const LightRecord& light = tables.lights[0];
    CheckDensity(tables.view, p, [&](Real a, Real b, Vector& point, Vector& n, Real& area) {
      if (a + b > 1) a = 1 - a, b = 1 - b;
      point = Vector{light.p[0], light.p[1], light.p[2]} +
              Vector{light.e1[0], light.e1[1], light.e1[2]} * a +
              Vector{light.e2[0], light.e2[1], light.e2[2]} * b;
      n = {light.n[0], light.n[1], light.n[2]};
      area = light.area;
    });
  }
}

TEST_CASE("SampleLight: directions to spheres and ellipsoids have the density they say") {
  for (const Affine& map : {Ball(1, 1, 2, 5), kEllipsoid}) {
    SceneBuilder builder;
    Shape& shape = builder.AddSphere(map);
    Emit(shape, 1);
    SceneTables tables = FinishScene(builder.scene);
    for (const Vector& p : {Vector{0, 0, 0}, {1, 2, 8}, {-3, 4, 5}}) {
      CheckDensity(tables.view, p, SpherePatch(builder.scene.spheres[0], 1));
    }
    shape.record.flags |= kShapeFlipNormal;  // emits to the inside
    tables = FinishScene(builder.scene);
    for (const Vector& p : {Vector{1, 2, 5}, {1.2L, 2.1L, 5.3L}}) {
      CheckDensity(tables.view, p, SpherePatch(builder.scene.spheres[0], -1));
    }
  }
}

TEST_CASE("SampleLight: infinite lights are drawn uniformly, points and directions exactly") {
  SceneBuilder infinite, point, distant;
  infinite.AddLight(kInfiniteLight, {1, 1, 1});
  point.AddLight(kPointLight, {8, 4, 2}, {3, 0, 4});
  distant.AddLight(kDistantLight, {3, 2, 1}, {0, 0.6f, 0.8f});
  const SceneTables a = FinishScene(infinite.scene), b = FinishScene(point.scene),
                    c = FinishScene(distant.scene);
  ForEachTarget([&](const char* target, Width width) {
    INFO(std::string(target), ", one lane: ", width == Width::kOneLane);
    const WordColumns sky = Draw(a.view, {1, 2, 3}, width);
    CHECK(std::abs(Estimate(sky, kMoments[0]) / (4 * kPi) - 1) < 1e-4);
    CHECK(std::abs(Estimate(sky, kMoments[1])) < 1e-4);
    CHECK(std::abs(Estimate(sky, kMoments[4]) / (4 * kPi / 3) - 1) < 1e-3);
    CHECK(std::abs(Estimate(sky, kMoments[5])) < 1e-3);
    CHECK(sky.Word(10, 5) == 1);
    const WordColumns bulb = Draw(b.view, {0, 0, 0}, width);
    const WordColumns sun = Draw(c.view, {1, 2, 3}, width);
    for (size_t i = 0; i < 20; ++i) {
      CHECK(reference::Length(At(bulb, 0, i) - Vector{0.6L, 0, 0.8L}) < 1e-6);
      CHECK(reference::Length(At(bulb, 3, i) - Vector{3, 0, 4}) == 0);
      CHECK(bulb.Float(6, i) == doctest::Approx(8.0 / 25).epsilon(1e-6));
      CHECK(bulb.Float(9, i) == 1.0f);
      CHECK(bulb.Word(10, i) == 2);
      CHECK(sun.Float(1, i) == 0.6f);
      CHECK(sun.Float(2, i) == 0.8f);
      CHECK(sun.Float(6, i) == 3.0f);
      CHECK(sun.Float(9, i) == 1.0f);
      CHECK(sun.Word(10, i) == 3);
    }
  });
}

TEST_CASE("SampleLight: is void on the dark side of one-sided lights, and only there") {
  const struct {
    bool two_sided, flip, inside;
  } cases[] = {{false, false, false}, {false, false, true}, {false, true, false},
               {false, true, true},   {true, false, false}, {true, false, true}};
  for (const auto& c : cases) {
    for (int kind = 0; kind < 2; ++kind) {
      SceneBuilder builder;
      Shape& shape = kind == 0 ? builder.AddMesh({-1, -1, 5, 1, -1, 5, 0, 1, 5}, {0, 1, 2})
                               : builder.AddSphere(Ball(1, 0, 0, 5));
      Emit(shape, 1, c.two_sided);
      if (c.flip) shape.record.flags |= kShapeFlipNormal;
      const SceneTables tables = FinishScene(builder.scene);
      // The triangle's outer side is above: "inside" is below, where z < 5.
      const Vector p =
          kind == 0 ? Vector{0, 0, c.inside ? 2.0L : 8} : Vector{0.2L, 0, c.inside ? 5.1L : 0};
      const bool shines = c.two_sided || c.flip == c.inside;
      ForEachTarget([&](const char* target, Width width) {
        INFO(std::string(target), ", kind: ", kind, ", flip: ", c.flip, ", inside: ", c.inside);
        const WordColumns samples = Draw(tables.view, p, width);
        for (size_t i = 0; i < samples.count(); ++i) REQUIRE((samples.Float(9, i) > 0) == shines);
      });
    }
  }
}

// Where the ray from p first meets the unit sphere's image.
Real DistanceToSphere(const SphereRecord& sphere, const Vector& p, const Vector& w) {
  const Vector o = reference::TransformPoint(sphere.world_to_object, p);
  const Vector d = reference::TransformPoint(sphere.world_to_object, p + w) - o;
  const Real a = reference::Dot(d, d), b = -reference::Dot(o, d), c = reference::Dot(o, o) - 1;
  return (b - std::sqrt(std::max(b * b - a * c, Real{0}))) / a;
}

TEST_CASE("LightPdf: is the density that SampleLight gave for the direction") {
  SceneBuilder builder;
  Emit(builder.AddMesh({0, 0, 3, 1, 2, 3, 2, 0, 3.5f}, {0, 1, 2}), 30);
  Emit(builder.AddSphere(Ball(1, 1, 2, 5)), 2);
  Emit(builder.AddSphere(kEllipsoid), 3);
  const SceneTables tables = FinishScene(builder.scene);
  for (const Vector& p : {Vector{0, 0, 0}, {1.5L, 0.5L, -1}}) {
    ForEachTarget([&](const char* target, Width width) {
      INFO(std::string(target), ", one lane: ", width == Width::kOneLane);
      const WordColumns samples = Draw(tables.view, p, width, 16);
      WordColumns in(7, samples.count());
      std::vector<bool> usable(samples.count());
      int seen[3] = {};
      for (size_t i = 0; i < samples.count(); ++i) {
        const uint32_t index = samples.Word(11, i);
        const LightRecord& light = tables.lights[index];
        const Vector w = At(samples, 0, i);
        Vector n{light.n[0], light.n[1], light.n[2]};
        // To the light itself, of which (0, 0, 3) is a vertex: shadow rays end a little before it.
        Real distance = reference::Dot(n, Vector{0, 0, 3} - p) / reference::Dot(n, w);
        Real scale = 1;
        if (light.type != kTriangleLight) {
          const SphereRecord& sphere = builder.scene.spheres[light.sphere];
          distance = DistanceToSphere(sphere, p, w);
          const Vector object = reference::TransformPoint(sphere.world_to_object, p + w * distance);
          const float* m = sphere.object_to_world;
          const Vector x{m[0], m[4], m[8]}, y{m[1], m[5], m[9]}, z{m[2], m[6], m[10]};
          n = reference::TransformNormal(sphere.world_to_object, object);
          scale = reference::Length(n) * std::abs(reference::Dot(x, reference::Cross(y, z)));
          n = reference::Normalize(n);
        }
        const Real cosine = -reference::Dot(n, w);
        usable[i] = samples.Float(9, i) > 0 && cosine > 0.1;  // else its own rounding shows
        seen[index] += usable[i];
        in.Word(0, i) = index;
        Put(in, 1, i, p);
        in.Set(4, i, float(distance));
        in.Set(5, i, float(cosine));
        in.Set(6, i, float(scale));
      }
      const WordColumns out = RunProbe(ProbeLightPdf, width, in, 1, &tables.view);
      for (size_t i = 0; i < out.count(); ++i) {
        if (usable[i]) REQUIRE(std::abs(out.Float(0, i) / samples.Float(9, i) - 1) < 1e-4);
      }
      for (int count : seen) CHECK(count > 1000);
    });
  }
}

// The map from a drawn direction back to strata of its triangle: shares of the solid angle that
// subtriangles cut off, computed in long double. Uniform directions fill all cells alike.
TEST_CASE("SampleLight: directions to a triangle are uniform in its solid angle") {
  const std::vector<float> kTriangles[] = {
      {0, 0, 1, 1, 0, 1, 0, 1, 1},               // 0.3 sr
      {-9, -9, 0.3f, 9, -9, 0.3f, 0, 12, 0.3f},  // 6 sr, near
      {0, 0, 3, 1.4f, 0, 3, 0, 1.7f, 3.1f},      // little more than the least, 0.1 sr
      {-3, 0.1f, 1, 3, 0.1f, 1, 3, 0.3f, 1.4f},  // long and thin
      {1, -2, 0.4f, 4, 1, 0.5f, 0.5f, 3, 0.6f},  // at a grazing angle
  };
  static constexpr uint32_t kCells = 8;
  for (const std::vector<float>& corners : kTriangles) {
    SceneBuilder builder;
    Emit(builder.AddMesh(corners, {0, 1, 2}), 1, /*two_sided=*/true);
    const SceneTables tables = FinishScene(builder.scene);
    const LightRecord& light = tables.lights[0];
    const Vector from{0.1L, 0.1L, 0};
    const Real angle = reference::SolidAngle(from, light);
    const Vector a = Vector{light.p[0], light.p[1], light.p[2]} - from;
    const Vector b = a + Vector{light.e1[0], light.e1[1], light.e1[2]};
    const Vector c = a + Vector{light.e2[0], light.e2[1], light.e2[2]};
    INFO("solid angle: ", double(angle));
    ForEachTarget([&](const char* target, Width width) {
      INFO(std::string(target), ", one lane: ", width == Width::kOneLane);
      const WordColumns samples = Draw(tables.view, from, width);
      std::vector<double> filled(kCells * kCells);
      for (size_t i = 0; i < samples.count(); ++i) {
        REQUIRE(samples.Float(9, i) == doctest::Approx(double(1 / angle)).epsilon(2e-4));
        // Where the arc from b through the direction meets the arc from a to c.
        const Vector w = At(samples, 0, i);
        const Vector crossing = reference::Cross(reference::Cross(b, w), reference::Cross(a, c));
        const Vector between = reference::Normalize(a) + reference::Normalize(c);
        const Real sign = reference::Dot(crossing, between) < 0 ? -1 : 1;
        const Vector m = reference::Normalize(crossing * sign);
        const Real share = reference::SolidAngle({}, a, b, m) / angle;
        const Vector unit_b = reference::Normalize(b);
        const Real along = reference::Length(w - unit_b) / reference::Length(m - unit_b);
        const auto cell = [](Real v) {
          return std::min(kCells - 1, uint32_t(std::max(v, Real(0)) * kCells));
        };
        ++filled[cell(share) * kCells + cell(along * along)];
      }
      // kSide^2 strata: only those on the borders of cells may fall to either side.
      const double expected = double(kSide) * kSide / (kCells * kCells);
      double statistic = 0;
      for (double n : filled) statistic += (n - expected) * (n - expected) / expected;
      CHECK(statistic < kCells * kCells - 1);
    });
  }
}

TEST_CASE("SampleLight: a triangle's density integrates to 1 over the directions that meet it") {
  SceneBuilder builder;
  Emit(builder.AddMesh({-1, -1, 1, 1.5f, -1, 1.2f, 0, 1, 0.7f}, {0, 1, 2}), 1, /*two_sided=*/true);
  const SceneTables tables = FinishScene(builder.scene);
  const LightRecord& light = tables.lights[0];
  const Vector p0{light.p[0], light.p[1], light.p[2]}, e1{light.e1[0], light.e1[1], light.e1[2]},
      e2{light.e2[0], light.e2[1], light.e2[2]}, n{light.n[0], light.n[1], light.n[2]};
  // Near, at some distance, and so far away that it is sampled by area.
  for (const Vector& from : {Vector{0, 0, 0}, {2, 3, -3}, {9, -20, 30}}) {
    constexpr uint32_t kSteps = 200;
    WordColumns in(7, kSteps * kSteps);
    std::vector<double> measure(in.count());
    for (uint32_t i = 0; i < in.count(); ++i) {
      Real s = (i % kSteps + 0.5L) / kSteps, t = (i / kSteps + 0.5L) / kSteps;
      if (s + t > 1) s = 1 - s, t = 1 - t;
      const Vector to = p0 + e1 * s + e2 * t - from;
      const Real distance = reference::Length(to);
      const Real cosine = -reference::Dot(n, to) / distance;
      measure[i] = double(std::abs(cosine) / (distance * distance) * light.area);
      in.Word(0, i) = 0;
      Put(in, 1, i, from);
      in.Set(4, i, float(distance));
      in.Set(5, i, float(cosine));
      in.Set(6, i, 1);
    }
    ForEachTarget([&](const char* target, Width width) {
      INFO(std::string(target), ", one lane: ", width == Width::kOneLane);
      const WordColumns out = RunProbe(ProbeLightPdf, width, in, 1, &tables.view);
      double sum = 0;
      for (uint32_t i = 0; i < in.count(); ++i) sum += out.Float(0, i) * measure[i];
      CHECK(std::abs(sum / in.count() - 1) < 1e-3);
    });
  }
}

// Irradiance at p on a plane with normal n.
Real Irradiance(const SceneView& view, const Vector& p, const Vector& n, Width width) {
  const WordColumns samples = Draw(view, p, width, 8);
  Real sum = 0;
  for (size_t i = 0; i < samples.count(); ++i) {
    if (samples.Float(9, i) <= 0) continue;
    const Real cosine = std::max<Real>(0, reference::Dot(n, At(samples, 0, i)));
    sum += samples.Float(6, i) * cosine / samples.Float(9, i);
  }
  return sum / Real(samples.count());
}

TEST_CASE("SampleLight: irradiance is the rectangle's form factor, the sphere's and the sky's") {
  SceneBuilder rectangle, sphere, sky;
  Emit(rectangle.AddRectangle({0, 0, 2}, {0, 3, 0}, {1, 0, 0}), 5);  // facing down
  Emit(sphere.AddSphere(Ball(1, 0, 0, 4)), 5);
  sky.AddLight(kInfiniteLight, {5, 5, 5});
  // Corner of a parallel rectangle (Howell, catalog of configuration factors, B-3).
  const Real a = 0.5L, b = 1.5L, ra = std::sqrt(1 + a * a), rb = std::sqrt(1 + b * b);
  const Real factor = (a / ra * std::atan(b / ra) + b / rb * std::atan(a / rb)) / (2 * kPi);
  const struct {
    const Scene& scene;
    Real expected;
  } cases[] = {
      {rectangle.scene, 5 * kPi * factor}, {sphere.scene, 5 * kPi / 16}, {sky.scene, 5 * kPi}};
  for (const auto& c : cases) {
    const SceneTables tables = FinishScene(c.scene);
    ForEachTarget([&](const char* target, Width width) {
      INFO(std::string(target), ", one lane: ", width == Width::kOneLane);
      const Real irradiance = Irradiance(tables.view, {0, 0, 0}, {0, 0, 1}, width);
      CHECK(std::abs(irradiance / c.expected - 1) < 1e-3);
    });
  }
}

TEST_CASE("PowerHeuristic: weights of two techniques sum to 1, for densities of all sizes") {
  const float densities[] = {1e-20f, 1e-3f, 1, 7, 1e6f, 1e18f};
  WordColumns in(2, 36), swapped(2, 36);
  for (uint32_t i = 0; i < 36; ++i) {
    in.Set(0, i, densities[i / 6]);
    in.Set(1, i, densities[i % 6]);
    swapped.Set(1, i, densities[i / 6]);
    swapped.Set(0, i, densities[i % 6]);
  }
  ForEachTarget([&](const char* target, Width width) {
    INFO(std::string(target));
    const WordColumns w = RunProbe(ProbePowerHeuristic, width, in, 1);
    const WordColumns other = RunProbe(ProbePowerHeuristic, width, swapped, 1);
    for (uint32_t i = 0; i < 36; ++i) {
      const double a = in.Float(0, i), b = in.Float(1, i);
      CHECK(w.Float(0, i) == doctest::Approx(a * a / (a * a + b * b)).epsilon(1e-6));
      CHECK(std::abs(w.Float(0, i) + other.Float(0, i) - 1) < 1e-6);
    }
  });
}

}  // namespace
}  // namespace swell::test
