// BuildBvh on scenes that are nothing but what is hard: coordinates that are not finite, no
// extent, planes, coincidence, objects without primitives.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "src/bvh/bvh.h"
#include "tests/support/bvh_scenes.h"
#include "tests/support/for_each_target.h"

namespace swell::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr BuildOptions kUncut = {.most_cuts = 0}, kCutAlways = {.most_cuts = 8, .cut_always = true};

// Valid with and without cuts, and no deeper than `most`.
void CheckBuilds(const Scene& scene, uint32_t most) {
  for (const BuildOptions& options : {BuildOptions(), kUncut, kCutAlways}) {
    INFO("cuts: ", options.most_cuts);
    const Result<Bvh> bvh = BuildBvh(scene, options);
    REQUIRE(bvh);
    CHECK(ValidateBvh(*bvh, scene) == "");
    CHECK(bvh->depth <= most);
  }
}

void CheckNoRayHits(const Scene& scene) {
  const Result<Bvh> bvh = BuildBvh(scene);
  REQUIRE(bvh);
  const RayTable rays(RaysFor({"", TriangleSoup(10, -1, 1, 1, 50), -1, 1}, 500, 51));
  ForEachTarget([&](const char* target, Width width) {
    INFO(target);
    for (const Traversal traversal : {Traversal::kPacket, Traversal::kSingle}) {
      for (const auto& hit : Intersect(*bvh, width, traversal, rays)) CHECK(hit.prim == kNoPrim);
    }
  });
}

// On the plane through the origin across (1, 2, 3).
Scene ObliquePlane(uint32_t count, float size) {
  const Float3 u = {3, 0, -1}, v = {-2, 1, 0};
  Random random(52);
  Scene scene;
  for (uint32_t i = 0; i < count; ++i) {
    const float x = random.Uniform(-1, 1), y = random.Uniform(-1, 1);
    const auto point = [&](float dx, float dy) -> Float3 {
      Float3 p;
      for (size_t k = 0; k < 3; ++k) p[k] = (x + size * dx) * u[k] + (y + size * dy) * v[k];
      return p;
    };
    AddTriangle(scene, point(0, 0), point(random.Uniform(), 0), point(0, random.Uniform()));
  }
  return scene;
}

}  // namespace

TEST_CASE("BuildBvh: of nothing but bad coordinates it makes a tree that no ray hits") {
  for (const float bad : {NAN, kInfinity, -kInfinity, 3e38f, -3e38f}) {
    INFO(bad);
    Scene all = TriangleSoup(3000, -1, 1, 0.1f, 53), one_vertex = all;
    for (float& x : all.positions) x = bad;
    for (size_t i = 0; i < one_vertex.positions.size(); i += 9) one_vertex.positions[i + 4] = bad;
    for (const Scene& scene : {all, one_vertex}) {
      CheckBuilds(scene, 6);
      CheckNoRayHits(scene);
    }
  }
}

TEST_CASE("BuildBvh: instances with bad maps are left out, and so is nothing else") {
  Scene scene;
  AddObject(scene, TriangleSoup(20, -1, 1, 0.1f, 54), 20, 0);
  for (int i = 0; i < 100; ++i) {
    AddInstance(scene, {1, 0, 0, static_cast<float>(i), 0, 1, 0, 0, 0, 0, 1, 0}, 0);
  }
  const size_t good = scene.instances.size();
  for (const float bad : {NAN, kInfinity, -kInfinity, 3e38f}) {
    InstanceRecord harmed = scene.instances[0];
    for (float& x : harmed.to_world) x = bad;
    scene.instances.push_back(harmed);
    harmed = scene.instances[1];
    harmed.centre[1] = bad;
    scene.instances.push_back(harmed);
  }
  REQUIRE(scene.instances.size() == good + 8);
  CheckBuilds(scene, 6);
}

TEST_CASE(
    "BuildBvh: no primitives, and instances of objects that have none, make a tree without hits") {
  Scene scene;
  CheckBuilds(scene, 1);
  CheckNoRayHits(scene);
  AddObject(scene, Scene(), 0, 0);
  CheckBuilds(scene, 1);
  for (int i = 0; i < 20; ++i) {
    AddInstance(scene, {1, 0, 0, static_cast<float>(i), 0, 1, 0, 0, 0, 0, 1, 0}, 0);
  }
  CheckBuilds(scene, 2);
  CheckNoRayHits(scene);
}

TEST_CASE("BuildBvh: points and lines alone are built, and no ray hits them") {
  Random random(55);
  Scene points, same_point, lines, line;
  for (int i = 0; i < 3000; ++i) {
    const Float3 a = random.Point(-1, 1), b = random.Point(-1, 1);
    AddTriangle(points, a, a, a);
    AddTriangle(same_point, {1, 2, 3}, {1, 2, 3}, {1, 2, 3});
    AddTriangle(lines, a, b, a);
    AddTriangle(line, {0, 0, 0}, {1, 1, 1}, {0.5f, 0.5f, 0.5f});
  }
  for (const Scene& scene : {points, same_point, lines, line}) {
    CheckBuilds(scene, 8);
    CheckNoRayHits(scene);
  }
}

TEST_CASE("BuildBvh: triangles in one plane, small and large, along the axes and across them") {
  for (const float size : {0.01f, 0.3f, 3.0f}) {
    INFO(size);
    CheckBuilds(ObliquePlane(5000, size), 14);
    for (size_t axis = 0; axis < 3; ++axis) {
      Scene scene = TriangleSoup(5000, -1, 1, size, 56);
      for (size_t i = axis; i < scene.positions.size(); i += 3) scene.positions[i] = 0.25f;
      CheckBuilds(scene, 14);
    }
  }
}

TEST_CASE("BuildBvh: coincident triangles, spheres and instances end in full leaves at any size") {
  for (const size_t count : {1u, 7u, 8u, 9u, 1000u, 4097u, 20000u}) {
    INFO(count);
    Scene scene;
    AddTriangle(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    for (size_t i = 1; i < count; ++i) scene.indices.insert(scene.indices.end(), {0, 1, 2});
    CheckBuilds(scene, 6);
    Scene spheres;
    AddSphere(spheres, {1, 2, 3}, 0.5f);
    spheres.spheres.resize(count, spheres.spheres[0]);
    CheckBuilds(spheres, 8);
    Scene instances;
    AddObject(instances, scene, 1, 0);
    AddInstance(instances, {1, 0, 0, 5, 0, 1, 0, 5, 0, 0, 1, 5}, 0);
    instances.instances.resize(count, instances.instances[0]);
    CheckBuilds(instances, 8);
  }
}

TEST_CASE("BuildBvh: triangles of one centre, which no plane parts, are built") {
  Random random(57);
  Scene scene;
  for (int i = 0; i < 20000; ++i) {
    const Float3 a = random.Point(-1, 1), b = {-a[0], -a[1], -a[2]};
    AddTriangle(scene, a, b, {a[0], b[1], a[2]});
  }
  CheckBuilds(scene, 8);
}

}  // namespace swell::test
