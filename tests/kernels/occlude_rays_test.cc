// OccludeRays against the closest hits, on every target.
#include "kernels/occlude_rays.h"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/bvh_scenes.h"
#include "tests/support/for_each_target.h"

namespace swell::test {
namespace {

constexpr Traversal kTraversals[] = {Traversal::kAuto, Traversal::kPacket, Traversal::kSingle};

// `count` rays through the scene that end somewhere near their closest hits, or at odd distances.
void CheckBlocked(const NamedScene& named, const Bvh& bvh, size_t count) {
  INFO("rows ", count);
  const RayTable rays(RaysFor(named, count, 200));
  ForEachTarget([&](const char* target, Width width) {
    const std::vector<HitFields<Row>> closest = Intersect(bvh, width, Traversal::kSingle, rays);
    Random random(201);
    std::vector<float> t_max;
    std::vector<bool> expected;
    for (size_t i = 0; i < count; ++i) {
      const float near = std::isfinite(closest[i].t) ? closest[i].t : 1.0f;
      const float choices[] = {INFINITY,    1.0f, near,  std::nextafter(near, INFINITY),
                               near * 0.5f, 0.0f, -1.0f, NAN};
      t_max.push_back(choices[random.Bits() % 8]);
      expected.push_back(closest[i].t < t_max.back());
    }
    for (const Traversal traversal : kTraversals) {
      INFO(NameRun(target, width, traversal));
      CHECK(Occluded(bvh, width, traversal, rays, t_max) == expected);
    }
  });
}

void CheckBlocked(const NamedScene& named, const std::vector<size_t>& counts) {
  INFO(named.name);
  const Result<Bvh> bvh = BuildBvh(named.scene);
  REQUIRE(bvh);
  for (const size_t count : counts) CheckBlocked(named, *bvh, count);
}

}  // namespace

TEST_CASE("OccludeRays: a ray is blocked exactly if its closest hit is before t_max") {
  for (const NamedScene& named : AllScenes()) {
    CheckBlocked(named, {std::begin(kRowCounts), std::end(kRowCounts)});
  }
}

TEST_CASE("OccludeRays: more rays than are sorted at a time") {
  CheckBlocked(AllScenes().front(), {8209});
}

TEST_CASE("OccludeRays: free rays add their radiance to their own path and to no other") {
  Scene scene;
  AddTriangle(scene, {-1, -1, 1}, {1, -1, 1}, {0, 1, 1});
  Result<Bvh> bvh = BuildBvh(scene);
  REQUIRE(bvh);
  std::vector<Ray> list;  // of one octant, so that whole vectors of them end in turn
  for (int i = 0; i < 17; ++i) list.push_back({{i % 2 == 0 ? 0.0f : 9.0f, 0, 0}, {0, 0, 1}});
  const RayTable rays(list);
  std::vector<float> t_max(48, INFINITY), light(48);
  for (uint32_t i = 0; i < 17; ++i) light[i] = static_cast<float>(i + 1);
  // The first path, and the step to the next.
  const std::pair<int, int> orders[] = {{40, -2}, {7, 1}};
  for (const auto& [first, step] : orders) {
    INFO("paths from ", first, " by ", step);
    std::vector<uint32_t> path(48, 0);
    for (int i = 0; i < 17; ++i) path[i] = static_cast<uint32_t>(first + step * i);
    const ShadowRaysIn shadow = {rays.org(),
                                 rays.dir(),
                                 t_max.data(),
                                 {light.data(), light.data(), light.data()},
                                 path.data()};
    std::vector<float> gain(48, 0.0f);
    for (uint32_t i = 1; i < 17; i += 2) gain[path[i]] = light[i];
    ForEachTarget([&](const char* target, Width width) {
      for (const Traversal traversal : kTraversals) {
        INFO(NameRun(target, width, traversal));
        std::vector<float> red(48, 0.5f), green(48, 0.25f), blue(48, 0.0f);
        OccludeRays(width, bvh->view(), traversal, shadow, {red.data(), green.data(), blue.data()},
                    17);
        for (uint32_t row = 0; row < 48; ++row) {
          CHECK(red[row] == 0.5f + gain[row]);
          CHECK(green[row] == 0.25f + gain[row]);
          CHECK(blue[row] == gain[row]);
        }
      }
    });
  }
}

}  // namespace swell::test
