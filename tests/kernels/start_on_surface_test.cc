// Rays that start exactly on a surface, of the world or of an instance: t = 0 is no hit.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>

#include "tests/support/bvh_scenes.h"
#include "tests/support/for_each_target.h"

namespace swell::test {
namespace {

constexpr Traversal kTraversals[] = {Traversal::kAuto, Traversal::kPacket, Traversal::kSingle};

// Two triangles of the square [-1, 1]^2 at z = 0 and at z = 2, and a sphere of radius 1 at (8, 0,
// 0).
Scene Stack() {
  Scene scene;
  for (const float z : {0.0f, 2.0f}) {
    AddTriangle(scene, {-1, -1, z}, {1, -1, z}, {1, 1, z});
    AddTriangle(scene, {-1, -1, z}, {1, 1, z}, {-1, 1, z});
  }
  AddSphere(scene, {8, 0, 0}, 1);
  return scene;
}

// All of it as an object; the map must be exact in floats, as those of powers of two are.
Scene Placed(const Affine& map) {
  Scene scene;
  AddObject(scene, Stack(), 4, 1);
  AddInstance(scene, map, 0);
  REQUIRE(scene.instances.size() == 1);
  return scene;
}

Ray Mapped(const Affine& m, const Ray& ray) {
  Ray mapped;
  for (int k = 0; k < 3; ++k) {
    const float* r = &m[4 * k];
    mapped.org[k] = r[0] * ray.org[0] + r[1] * ray.org[1] + r[2] * ray.org[2] + r[3];
    mapped.dir[k] = r[0] * ray.dir[0] + r[1] * ray.dir[1] + r[2] * ray.dir[2];
  }
  return mapped;
}

struct Case {
  Ray ray;
  float t;        // of the hit; infinity for none
  uint32_t prim;  // of it; of both on an edge, the least
};

// On faces, on the edge between two triangles, on vertices; away, along and through.
const Case kCases[] = {
    {{{0.25f, -0.5f, 0}, {0, 0, 1}}, 2, 2},
    {{{0.25f, -0.5f, 0}, {0, 0, -1}}, INFINITY, kNoPrim},
    {{{0.25f, -0.5f, 0}, {1, 0, 0}}, 7.75f - 0.8660254f, 4},
    {{{0.25f, -0.5f, 0}, {0, 0.5f, 1}}, 2, 3},
    {{{0.25f, -0.5f, 2}, {0, 0, -1}}, 2, 0},
    {{{0.25f, -0.5f, 2}, {0, 0, 1}}, INFINITY, kNoPrim},
    {{{0.25f, 0.25f, 0}, {0, 0, 1}}, 2, 2},
    {{{0.25f, 0.25f, 0}, {0, 0, -1}}, INFINITY, kNoPrim},
    {{{-1, -1, 0}, {0, 0, 1}}, 2, 2},
    {{{-1, -1, 0}, {0, 0, -1}}, INFINITY, kNoPrim},
    {{{1, 1, 2}, {0, 0, -4}}, 0.5f, 0},
    {{{7, 0, 0}, {1, 0, 0}}, 2, 4},
    {{{7, 0, 0}, {0, 1, 0}}, INFINITY, kNoPrim},
    {{{8, 0, 1}, {0, 0, 1}}, INFINITY, kNoPrim},
    {{{8, 0, 1}, {0, 0, -1}}, 2, 4},
};

void CheckAll(const Scene& scene, const Affine& map, uint32_t instance) {
  Result<Bvh> bvh = BuildBvh(scene);
  REQUIRE(bvh);
  std::vector<Ray> list;
  for (const Case& c : kCases) list.push_back(Mapped(map, c.ray));
  const RayTable rays(list);
  ForEachTarget([&](const char* target, Width width) {
    for (const Traversal traversal : kTraversals) {
      INFO(NameRun(target, width, traversal));
      const auto hits = Intersect(*bvh, width, traversal, rays);
      std::vector<float> none, all;
      for (size_t i = 0; i < std::size(kCases); ++i) {
        INFO("case ", i, ": ", Describe(hits[i]));
        CHECK(hits[i].prim == kCases[i].prim);
        CHECK(hits[i].instance == (kCases[i].prim == kNoPrim ? kNone : instance));
        if (kCases[i].prim != kNoPrim)
          CHECK(hits[i].t == doctest::Approx(kCases[i].t).epsilon(1e-6));
        none.push_back(0.0f);
        all.push_back(std::isfinite(hits[i].t) ? hits[i].t : 100.0f);
      }
      // Shadow rays: the segment is open at both ends.
      for (const bool blocked : Occluded(*bvh, width, traversal, rays, none)) CHECK(!blocked);
      for (const bool blocked : Occluded(*bvh, width, traversal, rays, all)) CHECK(!blocked);
      for (size_t i = 0; i < std::size(kCases); ++i) all[i] = std::nextafter(all[i], INFINITY);
      const std::vector<bool> beyond = Occluded(*bvh, width, traversal, rays, all);
      for (size_t i = 0; i < std::size(kCases); ++i)
        CHECK(beyond[i] == (kCases[i].prim != kNoPrim));
    }
  });
}

}  // namespace

TEST_CASE("Traversal: a ray that starts exactly on a surface does not hit it at t = 0") {
  const Affine same = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  CheckAll(Stack(), same, kNone);
}

TEST_CASE("Traversal: nor if the surface is an instance's") {
  const Affine maps[] = {
      {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0},       {1, 0, 0, 16, 0, 1, 0, -8, 0, 0, 1, 4},
      {0, -2, 0, 1, 0.5f, 0, 0, 2, 0, 0, 4, 3},    // turned and stretched
      {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 1},      // mirrored
      {0, 0, 0.25f, -1, 8, 0, 0, 0, 0, 1, 0, 64},  // axes change places
  };
  for (const Affine& map : maps) CheckAll(Placed(map), map, 0);
}

TEST_CASE("Traversal: nor if surfaces of the world and of instances coincide there") {
  Scene scene = Stack();
  AddObject(scene, Stack(), 4, 1);
  const Affine same = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  AddInstance(scene, same, 0);
  AddInstance(scene, same, 0);
  Result<Bvh> bvh = BuildBvh(scene);
  REQUIRE(bvh);
  const RayTable rays(std::vector<Ray>(17, Ray{{0.25f, -0.5f, 0}, {0, 0, 1}}));
  ForEachTarget([&](const char* target, Width width) {
    for (const Traversal traversal : kTraversals) {
      INFO(NameRun(target, width, traversal));
      for (const auto& hit : Intersect(*bvh, width, traversal, rays)) {
        // Of the three at t = 2, the least (instance, primitive).
        CHECK(hit.t == 2.0f);
        CHECK(hit.instance == 0);
        CHECK(hit.prim == 6);
      }
    }
  });
}

}  // namespace swell::test
