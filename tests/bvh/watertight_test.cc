// Rays through shared edges and vertices of closed meshes.
#include "tests/bvh/watertight.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "tests/support/for_each_target.h"

namespace swell::test {
namespace {

Bvh Build(const Scene& scene) {
  Result<Bvh> bvh = BuildBvh(scene);
  REQUIRE(bvh);
  return std::move(*bvh);
}

}  // namespace

TEST_CASE("ClosedSurfaces: every edge is shared by two triangles") {
  for (const ClosedSurface& surface : ClosedSurfaces(1)) {
    INFO(surface.name);
    // By place, because faces of the cube do not share the vertices of its edges.
    std::map<Float3, uint32_t> places;
    const auto place = [&](uint32_t vertex) {
      const float* p = &surface.scene.positions[3 * size_t{vertex}];
      return places.try_emplace({p[0], p[1], p[2]}, static_cast<uint32_t>(places.size()))
          .first->second;
    };
    std::map<std::pair<uint32_t, uint32_t>, int> uses;  // of an edge, whatever its direction
    const std::vector<uint32_t>& indices = surface.scene.indices;
    for (size_t i = 0; i < indices.size(); ++i) {
      const size_t next = i % 3 == 2 ? i - 2 : i + 1;
      ++uses[std::minmax(place(indices[i]), place(indices[next]))];
    }
    size_t open = 0;
    for (const auto& [edge, count] : uses) open += count != 2 || edge.first == edge.second;
    CHECK(open == 0);
  }
}

TEST_CASE("ClosedSurfaces: the inner ball is inside") {
  for (const ClosedSurface& surface : ClosedSurfaces(1)) {
    INFO(surface.name);
    const Bvh bvh = Build(surface.scene);
    Random random(93);
    std::vector<Ray> rays;
    for (int i = 0; i < 2000; ++i) {
      const Float3 p = random.Point(-1, 1);
      const float scale = surface.inner / std::hypot(p[0], p[1], p[2]);
      rays.push_back({surface.centre, {scale * p[0], scale * p[1], scale * p[2]}});
    }
    size_t near = 0;
    for (const auto& hit : Intersect(bvh, Width::kWide, Traversal::kAuto, RayTable(rays))) {
      near += hit.t < 1.0f;
    }
    CHECK(near == 0);
  }
}

TEST_CASE("Traversal: no ray slips through an edge or a vertex of a closed mesh") {
  for (const ClosedSurface& surface : ClosedSurfaces(1)) {
    const Bvh bvh = Build(surface.scene);
    const SurfaceRays rays = RaysThroughEdges(surface, 4096, 94);
    ForEachTarget([&](const char* target, Width width) {
      const Slips slips = CountSlips(surface, bvh, width, rays);
      INFO(std::string(target), ": ", slips.example);
      CHECK(slips.rays == 4096);
      CHECK(slips.slipped == 0);
    });
  }
}

TEST_CASE("Traversal: no ray slips through a closed mesh that is an instance") {
  const Affine maps[] = {
      {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0},
      {0.36f, 0.48f, -0.8f, 3, -0.8f, 0.6f, 0, -7, 0.48f, 0.64f, 0.6f, 0.5f},  // turned
      {3, 0.3f, 0, 1, 0.7f, -0.4f, 0.1f, 2, 0.2f, 0, 1.3f, -3},                // mirrored, sheared
  };
  for (const ClosedSurface& surface : ClosedSurfaces(1)) {
    for (const Affine& map : maps) {
      ClosedSurface placed = surface;
      placed.scene = Scene();
      AddObject(placed.scene, surface.scene, static_cast<uint32_t>(surface.scene.triangle_count()),
                0);
      AddInstance(placed.scene, map, 0);
      REQUIRE(placed.scene.instances.size() == 1);
      // The mapped rays pass the edges within rounding.
      SurfaceRays rays = RaysThroughEdges(surface, 4096, 96);
      for (Ray& ray : rays.rays) {
        const Ray from = ray;
        for (int k = 0; k < 3; ++k) {
          const float* m = &map[4 * k];
          ray.org[k] = m[0] * from.org[0] + m[1] * from.org[1] + m[2] * from.org[2] + m[3];
          ray.dir[k] = m[0] * from.dir[0] + m[1] * from.dir[1] + m[2] * from.dir[2];
        }
      }
      const Bvh bvh = Build(placed.scene);
      ForEachTarget([&](const char* target, Width width) {
        const Slips slips = CountSlips(placed, bvh, width, rays);
        INFO(std::string(target), ": ", slips.example);
        CHECK(slips.rays == 4096);
        CHECK(slips.slipped == 0);
      });
    }
  }
}

TEST_CASE("CountSlips: notices a mesh with triangles missing") {
  for (ClosedSurface& surface : ClosedSurfaces(1)) {
    INFO(surface.name);
    const SurfaceRays rays = RaysThroughEdges(surface, 20000, 95);
    surface.scene.indices.resize(surface.scene.indices.size() - 3 * 20);
    CHECK(CountSlips(surface, Build(surface.scene), Width::kWide, rays).slipped > 0);
  }
}

}  // namespace swell::test
