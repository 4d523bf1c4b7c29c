// Coherent rays, as bundles take them, against the scalar reference and against single rays, on
// every target.
#include <doctest/doctest.h>

#include <cmath>

#include "kernels/intersect_rays.h"
#include "tests/support/bvh_scenes.h"
#include "tests/support/count_different.h"
#include "tests/support/for_each_target.h"

namespace swell::test {
namespace {

constexpr size_t kRaysOfBundle = 67;  // a whole one, and three that are left
constexpr int kBundles = 10;          // of each kind

Float3 Nudged(Random& random, const Float3& at, float most) {
  const Float3 by = random.Point(-most, most);
  return {at[0] + by[0], at[1] + by[1], at[2] + by[2]};
}

Ray Towards(const Float3& from, const Float3& to) {
  return {from, {to[0] - from[0], to[1] - from[1], to[2] - from[2]}};
}

Float3 VertexOf(const Scene& scene, uint32_t corner) {
  const size_t row = 3 * size_t{scene.indices[corner]};
  return {scene.positions[row], scene.positions[row + 1], scene.positions[row + 2]};
}

enum class Kind {
  kOneOrigin,
  kParallel,
  kNear,
  kAtEdges,
  kAlongAxis,
  kSomeWithoutDirection,
  kBetweenAxes,
  kFromTriangle,
  kKinds
};

// A bundle whose rays are as far from each other as `size`.
void AddBundle(const NamedScene& named, Kind kind, float size, Random& random,
               std::vector<Ray>& rays) {
  const Float3 org = random.Point(named.low, named.high);
  const Float3 to = random.Point(named.low, named.high);
  const auto corners = static_cast<uint32_t>(named.scene.indices.size());
  for (size_t i = 0; i < kRaysOfBundle; ++i) {
    const Float3 near_org = Nudged(random, org, size), near_to = Nudged(random, to, size);
    if (kind == Kind::kOneOrigin) {
      rays.push_back(Towards(org, near_to));
    } else if (kind == Kind::kParallel) {
      rays.push_back({near_org, {to[0] - org[0], to[1] - org[1], to[2] - org[2]}});
    } else if (kind == Kind::kSomeWithoutDirection) {  // zeros are of octant 0 and axis x
      Ray ray = Towards(near_org, near_to);
      for (float& d : ray.dir) d = i / 16 == 2 ? 0.0f : std::fabs(d);
      ray.dir[0] += ray.dir[1] + ray.dir[2];
      rays.push_back(ray);
    } else if (kind == Kind::kBetweenAxes) {  // any axis may dominate
      const Float3 dir = Nudged(random, {1, -1, 1}, 0.25f * size / (named.high - named.low));
      rays.push_back({near_org, dir});
    } else if (kind == Kind::kNear || corners == 0) {
      rays.push_back(Towards(near_org, near_to));
    } else if (kind == Kind::kAtEdges) {  // vertices and points of edges of one triangle
      const uint32_t first = 3 * (random.Bits() % (corners / 3));
      const Float3 a = VertexOf(named.scene, first + random.Bits() % 3);
      const Float3 b = VertexOf(named.scene, first + random.Bits() % 3);
      const float at = 0.25f * static_cast<float>(random.Bits() % 5);
      rays.push_back(Towards(
          org, {a[0] + at * (b[0] - a[0]), a[1] + at * (b[1] - a[1]), a[2] + at * (b[2] - a[2])}));
    } else if (kind == Kind::kFromTriangle) {  // of the first triangle, from points near its plane
      const Float3 a = VertexOf(named.scene, 0), b = VertexOf(named.scene, 1);
      const Float3 c = VertexOf(named.scene, 2);
      const float u = random.Uniform(0, 0.5f), v = random.Uniform(0, 0.5f);
      Float3 from;
      for (size_t k = 0; k < 3; ++k) from[k] = a[k] + u * (b[k] - a[k]) + v * (c[k] - a[k]);
      rays.push_back(Towards(from, near_to));
    } else {
      const uint32_t axis = random.Bits() % 3;
      Ray ray{near_org, {random.Bits() % 2 == 0 ? 0.0f : -0.0f, 0.0f, -0.0f}};
      ray.dir[axis] = i % 2 == 0 ? 1.0f : -1.0f;
      rays.push_back(ray);
    }
  }
}

std::vector<Ray> Bundles(const NamedScene& named) {
  Random random(77);
  std::vector<Ray> rays;
  for (int kind = 0; kind < static_cast<int>(Kind::kKinds); ++kind) {
    for (int i = 0; i < kBundles; ++i) {
      const float size = (named.high - named.low) * std::ldexp(0.5f, -2 * i);
      AddBundle(named, static_cast<Kind>(kind), size, random, rays);
    }
  }
  return rays;
}

// Calls check(tree, coherent rays, the reference's hits) for every scene.
template <class Check> void ForEachScene(const Check& check) {
  for (const NamedScene& named : AllScenes()) {
    INFO(named.name);
    const Result<Bvh> bvh = BuildBvh(named.scene);
    REQUIRE(bvh);
    const std::vector<Ray> rays = Bundles(named);
    std::vector<HitFields<Row>> closest;
    size_t hits = 0;
    for (const Ray& ray : rays) {
      closest.push_back(reference::ClosestHit(named.scene, ray));
      hits += closest.back().prim != kNoPrim;
    }
    CHECK((hits > 0) == (named.name != "nothing"));
    check(*bvh, RayTable(rays), closest);
  }
}

// Where the rays of a run end: where they aim at, around their hits, at their hits.
float EndOf(int run, size_t row, float closest) {
  if (run == 0 || !std::isfinite(closest)) return 1.0f;
  const float at[] = {1.0f, std::nextafter(closest, INFINITY), closest * (1.0f + 0x1p-20f),
                      closest * (1.0f - 0x1p-20f)};
  return run == 1 ? closest : at[row % 4];
}

}  // namespace

TEST_CASE("bundles: coherent rays find the reference's hits to the bit") {
  ForEachScene(
      [](const Bvh& bvh, const RayTable& rays, const std::vector<HitFields<Row>>& closest) {
        ForEachTarget([&](const char* target, Width width) {
          const auto single = Intersect(bvh, width, Traversal::kSingle, rays);
          for (const Traversal traversal : {Traversal::kPacket, Traversal::kAuto}) {
            INFO(NameRun(target, width, traversal));
            const auto got = Intersect(bvh, width, traversal, rays);
            CHECK(CountDifferent(got, single) == 0);
            if (HasFma(target)) CHECK(CountDifferent(got, closest) == 0);
          }
        });
      });
}

TEST_CASE("bundles: coherent shadow rays are blocked if the reference's hit is before their end") {
  ForEachScene(
      [](const Bvh& bvh, const RayTable& rays, const std::vector<HitFields<Row>>& closest) {
        for (int run = 0; run < 3; ++run) {
          std::vector<float> t_max;
          std::vector<bool> expected;
          for (size_t i = 0; i < closest.size(); ++i) {
            t_max.push_back(EndOf(run, i, closest[i].t));
            expected.push_back(closest[i].t < t_max[i]);
          }
          ForEachTarget([&](const char* target, Width width) {
            const auto single = Occluded(bvh, width, Traversal::kSingle, rays, t_max);
            if (HasFma(target)) CHECK(single == expected);
            for (const Traversal traversal : {Traversal::kPacket, Traversal::kAuto}) {
              INFO(NameRun(target, width, traversal), ", run ", run);
              CHECK(Occluded(bvh, width, traversal, rays, t_max) == single);
            }
          });
        }
      });
}

}  // namespace swell::test
