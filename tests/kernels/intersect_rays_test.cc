// IntersectRays against the scalar reference and against itself, on every target.
#include "kernels/intersect_rays.h"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/bvh_scenes.h"
#include "tests/support/count_different.h"
#include "tests/support/for_each_target.h"

namespace swell::test {
namespace {

constexpr Traversal kTraversals[] = {Traversal::kAuto, Traversal::kPacket, Traversal::kSingle};

Bvh Build(const Scene& scene) {
  Result<Bvh> bvh = BuildBvh(scene);
  REQUIRE(bvh);
  return std::move(*bvh);
}

// Calls check(hits) for every traversal of every target with fused multiply-add, or without.
template <class Check>
void ForEachRun(const Bvh& bvh, const RayTable& rays, bool fma, const Check& check) {
  ForEachTarget([&](const char* target, Width width) {
    if (HasFma(target) != fma) return;
    for (const Traversal traversal : kTraversals) {
      INFO(NameRun(target, width, traversal));
      check(Intersect(bvh, width, traversal, rays));
    }
  });
}

}  // namespace

TEST_CASE(
    "IntersectRays: every target, width and traversal finds the reference's hits to the bit") {
  for (const NamedScene& named : AllScenes()) {
    INFO(named.name);
    const Bvh bvh = Build(named.scene);
    for (const size_t count : kRowCounts) {
      const std::vector<Ray> rays = RaysFor(named, count, 100);
      std::vector<HitFields<Row>> expected;
      for (const Ray& ray : rays) {
        const bool finite = std::isfinite(ray.org[0] + ray.org[1] + ray.org[2] + ray.dir[0] +
                                          ray.dir[1] + ray.dir[2]);
        expected.push_back(finite ? reference::ClosestHit(named.scene, ray)
                                  : HitFields<Row>{INFINITY, kNoPrim, 0.0f, 0.0f, kNone});
      }
      ForEachRun(bvh, RayTable(rays), true, [&](const std::vector<HitFields<Row>>& hits) {
        CHECK(CountDifferent(hits, expected) == 0);
      });
    }
  }
}

TEST_CASE(
    "IntersectRays: without fused multiply-add, the traversals of a target agree to the bit") {
  for (const NamedScene& named : AllScenes()) {
    INFO(named.name);
    const Bvh bvh = Build(named.scene);
    const RayTable rays(RaysFor(named, 1000, 101));
    std::vector<HitFields<Row>> first;
    ForEachRun(bvh, rays, false, [&](const std::vector<HitFields<Row>>& hits) {
      if (first.empty()) first = hits;
      CHECK(CountDifferent(hits, first) == 0);
    });
  }
}

TEST_CASE("IntersectRays: finds the hits of double precision where those are certain") {
  for (const NamedScene& named : AllScenes()) {
    if (named.name == "slivers") continue;  // nothing of a sliver is certain
    INFO(named.name);
    const Bvh bvh = Build(named.scene);
    Random random(102);
    std::vector<Ray> rays;
    for (int i = 0; i < 1000; ++i) {
      const Float3 from = random.Point(named.low, named.high);
      const Float3 to = random.Point(named.low, named.high);
      rays.push_back({from, {to[0] - from[0], to[1] - from[1], to[2] - from[2]}});
    }
    size_t certain = 0;
    std::vector<reference::ExactHit> exact;
    for (const Ray& ray : rays) {
      exact.push_back(reference::ExactClosestHit(named.scene, ray));
      certain += exact.back().certain;
    }
    const bool coincident = named.name == "duplicates" || named.name == "coincident instances";
    CHECK(certain > (coincident ? 200 : 800));
    for (const bool fma : {true, false}) {
      // Without fused multiply-add, a sphere of 1e6 is good to a tenth of a unit only.
      if (!fma && named.name == "all scales") continue;
      ForEachRun(bvh, RayTable(rays), fma, [&](const std::vector<HitFields<Row>>& hits) {
        size_t wrong = 0;
        for (size_t i = 0; i < rays.size(); ++i) {
          if (!exact[i].certain) continue;
          const bool same =
              hits[i].prim == exact[i].prim && hits[i].instance == exact[i].instance &&
              (hits[i].prim == kNoPrim || std::fabs(hits[i].t - exact[i].t) <= 1e-3 * exact[i].t);
          wrong += !same;
        }
        CHECK(wrong == 0);
      });
    }
  }
}

TEST_CASE("IntersectRays: of coincident triangles the least primitive wins") {
  Scene scene;
  for (int i = 0; i < 100; ++i) AddTriangle(scene, {-1, -1, 0}, {1, -1, 0}, {0, 1, 0});
  const Bvh bvh = Build(scene);
  const RayTable rays(std::vector<Ray>(17, Ray{{0, 0, -1}, {0, 0, 1}}));
  for (const bool fma : {true, false}) {
    ForEachRun(bvh, rays, fma, [&](const std::vector<HitFields<Row>>& hits) {
      for (const HitFields<Row>& hit : hits) {
        CHECK(hit.prim == 0);
        CHECK(hit.t == 1.0f);
      }
    });
  }
}

TEST_CASE("IntersectRays: no ray leaves a closed mesh through a shared edge or vertex") {
  const struct {
    uint32_t levels;
    float size;
    Float3 centre;
  } kMeshes[] = {{0, 1, {0, 0, 0}},
                 {3, 1, {0, 0, 0}},
                 {5, 1, {0, 0, 0}},
                 {4, 1e-3f, {1, 2, 3}},
                 {4, 1e6f, {0, 1e5f, 0}}};
  for (const auto& mesh : kMeshes) {
    const Scene scene = ClosedMesh(mesh.levels, mesh.size, mesh.centre, 40);
    const Bvh bvh = Build(scene);
    Random random(41);
    std::vector<Ray> rays;
    const auto vertex = [&](size_t corner) {
      return &scene.positions[3 * size_t{scene.indices[corner]}];
    };
    while (rays.size() < 40000) {
      const size_t triangle = random.Bits() % scene.triangle_count();
      const size_t k = random.Bits() % 3;
      const float* a = vertex(3 * triangle + k);
      const float* b = vertex(3 * triangle + (k + 1) % 3);
      const float s = rays.size() % 4 == 0 ? 0.0f : random.Uniform();
      Ray ray;
      // The mesh is within [0.8, 1] of its size around its centre, and flat parts between.
      const Float3 offset = random.Point(-0.3f, 0.3f);
      for (int axis = 0; axis < 3; ++axis) {
        ray.org[axis] =
            rays.size() % 3 == 0 ? mesh.centre[axis] : mesh.centre[axis] + mesh.size * offset[axis];
        ray.dir[axis] = a[axis] + s * (b[axis] - a[axis]) - ray.org[axis];
      }
      rays.push_back(ray);
    }
    for (const bool fma : {true, false}) {
      ForEachRun(bvh, RayTable(rays), fma, [&](const std::vector<HitFields<Row>>& hits) {
        size_t escaped = 0;
        for (const HitFields<Row>& hit : hits) escaped += hit.prim == kNoPrim;
        CHECK(escaped == 0);
      });
    }
  }
}

TEST_CASE("IntersectRays: rays that start off a sphere do not meet it where they start") {
  for (const float radius : {1e-3f, 1.0f, 1e6f}) {
    for (const Float3 centre : {Float3{0, 0, 0}, Float3{1, 2, -3}, Float3{300, 0, -700}}) {
      INFO("radius ", radius, ", centre ", centre[0], " ", centre[1], " ", centre[2]);
      Scene scene;
      AddSphere(scene, centre, radius);
      const Bvh bvh = Build(scene);
      // Points on the sphere, off by 16 roundings of the largest number involved.
      const float off =
          16 * 0x1p-24f *
          (radius + std::fabs(centre[0]) + std::fabs(centre[1]) + std::fabs(centre[2]));
      Random random(50);
      std::vector<Ray> outward, inward;
      for (int i = 0; i < 4000; ++i) {
        Float3 n = random.Point(-1, 1), d = random.Point(-1, 1);
        const float length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        if (length < 0.1f || off > 0.01f * radius) continue;
        for (float& x : n) x /= length;
        float cosine = d[0] * n[0] + d[1] * n[1] + d[2] * n[2];
        if (cosine < 0) {
          cosine = -cosine;
          for (float& x : d) x = -x;
        }
        if (i % 2 == 0) {  // grazing
          for (int k = 0; k < 3; ++k) d[k] -= (1 - 1e-3f) * cosine * n[k];
        }
        Ray out, in;
        for (int k = 0; k < 3; ++k) {
          out.org[k] = centre[k] + (radius + off) * n[k];
          out.dir[k] = d[k];
          in.org[k] = centre[k] + (radius - off) * n[k];
          in.dir[k] = i % 2 == 0 ? d[k] : -d[k];
        }
        outward.push_back(out);
        if (i % 2 != 0 && cosine > 0.1f) inward.push_back(in);
      }
      for (const bool fma : {true, false}) {
        ForEachRun(bvh, RayTable(outward), fma, [&](const std::vector<HitFields<Row>>& hits) {
          size_t hit_count = 0;
          for (const HitFields<Row>& hit : hits) hit_count += hit.prim != kNoPrim;
          CHECK(hit_count == 0);
        });
        ForEachRun(bvh, RayTable(inward), fma, [&](const std::vector<HitFields<Row>>& hits) {
          size_t wrong = 0;  // the far side is at 2 cos, at least 0.1 of the radius away
          for (const HitFields<Row>& hit : hits) {
            wrong += hit.prim == kNoPrim || hit.t < 0.05f * radius;
          }
          CHECK(wrong == 0);
        });
      }
    }
  }
}

TEST_CASE("IntersectRays: a camera inside and far outside hits spheres of 1e-3 and 1e6 at once") {
  Scene scene;
  AddSphere(scene, {0, 1e-3f, 0}, 1e-3f);
  AddSphere(scene, {0, -1e6f, 0}, 1e6f);
  const Bvh bvh = Build(scene);
  const RayTable rays({{{0, 1e-3f, -0.1f}, {0, 0, 1}},
                       {{0.5f, 1, 0}, {0, -1, 0}},
                       {{1, -1e6f, 0}, {0, 1, 0}},
                       {{0, 1e-3f, 0}, {0, 1, 0}}});
  for (const bool fma : {true, false}) {
    ForEachRun(bvh, rays, fma, [&](const std::vector<HitFields<Row>>& hits) {
      CHECK(hits[0].prim == 0);
      CHECK(hits[0].t == doctest::Approx(0.099).epsilon(1e-5));
      CHECK(hits[1].prim == 1);
      CHECK(hits[1].t == doctest::Approx(1).epsilon(0.1));
      CHECK(hits[2].prim == 1);
      CHECK(hits[2].t == doctest::Approx(1e6).epsilon(1e-5));
      CHECK(hits[3].prim == 0);
      CHECK(hits[3].t == doctest::Approx(1e-3).epsilon(1e-5));
    });
  }
}

TEST_CASE("IntersectRays: close to a sphere of 1e6, distances are good to a millionth of a unit") {
  Scene scene;
  AddSphere(scene, {0, -1e6f, 0}, 1e6f);
  const Bvh bvh = Build(scene);
  Random random(80);
  std::vector<Ray> rays;
  for (int i = 0; i < 1000; ++i) {
    rays.push_back({{random.Uniform(-10, 10), random.Uniform(1e-3f, 1), random.Uniform(-10, 10)},
                    {random.Uniform(-1, 1), -1, random.Uniform(-1, 1)}});
  }
  ForEachRun(bvh, RayTable(rays), true, [&](const std::vector<HitFields<Row>>& hits) {
    size_t wrong = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
      const double t = reference::ExactClosestHit(scene, rays[i]).t;
      wrong += !(std::fabs(hits[i].t - t) < 1e-6 * std::max(1.0, t));
    }
    CHECK(wrong == 0);
  });
}

TEST_CASE("IntersectRays: a millionth off a sphere of 1e6 is the right side of it") {
  Scene scene;
  AddSphere(scene, {0, -1e6f, 0}, 1e6f);
  const Bvh bvh = Build(scene);
  const double radius = 1.0 / double{scene.spheres[0].world_to_object[0]};
  Random random(81);
  std::vector<Ray> outside, inside;
  for (int i = 0; i < 1000; ++i) {
    const float x = random.Uniform(-1, 1), z = random.Uniform(-1, 1);
    const double y = std::sqrt(radius * radius - double{x} * x - double{z} * z) - 1e6;
    const Float3 dir = {random.Uniform(-1, 1), i % 2 == 0 ? 1e-5f : random.Uniform(0.1f, 1),
                        random.Uniform(-1, 1)};
    outside.push_back({{x, static_cast<float>(y + 1e-6), z}, dir});
    inside.push_back({{x, static_cast<float>(y - 1e-6), z}, {dir[0], -1, dir[2]}});
  }
  ForEachRun(bvh, RayTable(outside), true, [&](const std::vector<HitFields<Row>>& hits) {
    size_t hit_count = 0;
    for (const HitFields<Row>& hit : hits) hit_count += hit.prim != kNoPrim;
    CHECK(hit_count == 0);
  });
  ForEachRun(bvh, RayTable(inside), true, [&](const std::vector<HitFields<Row>>& hits) {
    size_t wrong = 0;
    for (const HitFields<Row>& hit : hits) wrong += hit.prim == kNoPrim || hit.t < 1e5f;
    CHECK(wrong == 0);
  });
}

TEST_CASE("IntersectRays: lane use counts no more lanes active than issued") {
  const Scene scene = ClosedMesh(4, 1, {0, 0, 0}, 6);
  const Bvh bvh = Build(scene);
  const RayTable rays(RaysFor({"", scene, -1, 1}, 1000, 60));
  std::vector<float> column(2048);
  std::vector<uint32_t> prim(2048);
  const HitsOut hits = {column.data(), prim.data(), column.data() + 1024, column.data() + 1024,
                        prim.data() + 1024};
  ForEachTarget([&](const char* target, Width width) {
    INFO(std::string(target));
    for (const Traversal traversal : kTraversals) {
      const LaneUse use =
          IntersectRays(width, bvh.view(), traversal, rays.org(), rays.dir(), hits, rays.count);
      CHECK(use.active > rays.count);
      CHECK(use.active <= use.issued);
    }
  });
}

}  // namespace swell::test
