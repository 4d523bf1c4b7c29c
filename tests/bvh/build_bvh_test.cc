// BuildBvh on geometry that is easy, large, degenerate or not finite.
#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstring>

#include "src/bvh/bvh.h"
#include "tests/support/bvh_scenes.h"

namespace swell::test {
namespace {

Bvh Build(const Scene& scene) {
  Result<Bvh> bvh = BuildBvh(scene);
  REQUIRE(bvh);
  CHECK(ValidateBvh(*bvh, scene) == "");
  return std::move(*bvh);
}

}  // namespace

TEST_CASE("BuildBvh: every primitive of every scene is in one leaf within its boxes") {
  for (const NamedScene& named : AllScenes()) {
    INFO(named.name);
    Build(named.scene);
  }
}

TEST_CASE("BuildBvh: a million coincident triangles end in bounded depth and full leaves") {
  Scene scene;
  AddTriangle(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  for (int i = 1; i < 1000000; ++i) scene.indices.insert(scene.indices.end(), {0, 1, 2});
  const Bvh bvh = Build(scene);
  CHECK(bvh.depth <= 12);
  CHECK(bvh.bytes() <= 75u * 1000000u);
}

TEST_CASE("BuildBvh: boxes that halve without end stay within the depth") {
  Scene scene;
  for (int i = 0; i < 4000; ++i) {
    const float x = std::pow(0.97f, static_cast<float>(i));
    AddTriangle(scene, {x, 0, 0}, {x * 0.98f, x, 0}, {x, 0, x});
  }
  CHECK(Build(scene).depth <= kMaxBvhDepth);
}

TEST_CASE("BuildBvh: long diagonal slivers and a single triangle are built") {
  Scene scene;
  AddTriangle(scene, {0, 0, 0}, {1, 1, 1}, {0, 1, 0});
  Build(scene);
  Random random(75);
  for (int i = 0; i < 20000; ++i) {
    const Float3 a = random.Point(-1, 0), b = random.Point(0, 1);
    AddTriangle(scene, a, b, {b[0] + 1e-5f, b[1], b[2]});
  }
  CHECK(Build(scene).depth <= 24);
}

TEST_CASE("BuildBvh: planar meshes, points and lines are built") {
  Scene scene;
  for (int i = 0; i < 100; ++i) {
    for (int k = 0; k < 100; ++k) {
      const float x = static_cast<float>(i), y = static_cast<float>(k);
      AddTriangle(scene, {x, y, 0}, {x + 1, y, 0}, {x, y + 1, 0});
      AddTriangle(scene, {x, y, 0}, {x, y, 0}, {x, y, 0});
      AddTriangle(scene, {x, y, 0}, {x + 1, y, 0}, {x + 2, y, 0});
    }
  }
  Build(scene);
}

TEST_CASE("BuildBvh: coordinates that are not finite neither hang nor harm the others") {
  Scene scene = TriangleSoup(1000, -1, 1, 0.1f, 70);
  const float bad[] = {NAN, INFINITY, -INFINITY, 3e38f};
  for (size_t i = 0; i < scene.positions.size(); i += 37) scene.positions[i] = bad[i % 4];
  scene.spheres.resize(3);
  for (float& x : scene.spheres[0].object_to_world) x = NAN;
  for (float& x : scene.spheres[1].object_to_world) x = INFINITY;
  AddSphere(scene, {0, 0, 0}, 0.1f);
  const Bvh bvh = Build(scene);
  for (const float* column : bvh.nodes[0].bounds) {
    for (uint32_t i = 0; i < ChildCount(bvh.nodes[0]); ++i) CHECK(std::fabs(column[i]) < 2.0f);
  }
}

TEST_CASE("BuildBvh: one tree whatever the number of threads") {
  const Scene scene = TriangleSoup(100000, -1, 1, 0.01f, 71);
  const auto build = [&](size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return Build(scene);
  };
  const Bvh one = build(1), two = build(2);
  REQUIRE(one.nodes.size() == two.nodes.size());
  REQUIRE(one.blocks.size() == two.blocks.size());
  CHECK(std::memcmp(one.nodes.data(), two.nodes.data(), one.nodes.size() * sizeof(BvhNode)) == 0);
  CHECK(std::memcmp(one.blocks.data(), two.blocks.data(),
                    one.blocks.size() * sizeof(TriangleBlock)) == 0);
}

TEST_CASE("BuildBvh: progress ends at all of the primitives") {
  for (const float most_cuts : {0.0f, 1.0f}) {
    const Scene scene = TriangleSoup(60000, -1, 1, 0.1f, 74);
    BuildProgress progress;
    REQUIRE(BuildBvh(scene, {.most_cuts = most_cuts, .progress = &progress}));
    CHECK(progress.done == kBuildSteps * scene.triangle_count());
  }
}

TEST_CASE("BuildBvh: a mesh takes at most 75 bytes a triangle") {
  const Scene scene = ClosedMesh(7, 1, {0, 0, 0}, 72);
  CHECK(Build(scene).bytes() <= 75 * scene.triangle_count());
}

TEST_CASE("BuildBvh: an instance takes at most 150 bytes with all that is kept of it") {
  const auto fill = [](int kind, uint32_t count) {
    Scene scene;
    AddObject(scene, TriangleSoup(300, -0.5f, 0.5f, 0.1f, 75), 300, 0);
    Random random(76);
    const float side = std::sqrt(static_cast<float>(count));
    for (uint32_t i = 0; i < count; ++i) {
      const float c = random.Uniform(-1, 1), s = std::sqrt(1 - c * c);
      Affine map = {c, 0, s, 0, 0, 1, 0, 0, -s, 0, c, 0};
      if (kind < 3) map[3] = random.Uniform(0, side);
      if (kind < 2) map[7] = random.Uniform(0, kind == 0 ? side : 3);
      if (kind < 2) map[11] = random.Uniform(0, side);
      AddInstance(scene, map, 0);  // in space, in a layer, on a line, all at one place
    }
    return scene;
  };
  for (int kind = 0; kind < 4; ++kind) {
    INFO("kind ", kind);
    const Scene one = fill(kind, 1), many = fill(kind, 100000);
    const size_t records = many.instances.size() * sizeof(InstanceRecord);
    const size_t tree = Build(many).bytes() - Build(one).bytes();
    MESSAGE("bytes an instance: ", (records + tree) / 100000.0);
    CHECK(records + tree <= 150u * 100000u);
  }
}

TEST_CASE("BuildBvh: ten thousand objects, and one that is not used, make one tree each") {
  Scene scene;
  for (uint32_t i = 0; i < 10000; ++i) {
    AddObject(scene, TriangleSoup(3, -1, 1, 0.1f, i), 3, 0);
    if (i == 5000) continue;
    const auto x = static_cast<float>(i % 100), y = static_cast<float>(i) / 100;
    AddInstance(scene, {1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, 0}, i);
  }
  const Bvh bvh = Build(scene);
  CHECK(bvh.blocks.size() == 9999);
}

TEST_CASE("BuildBvh: instances that are too far away to be hit do not harm the others") {
  Scene scene = TriangleSoup(10, -1, 1, 0.1f, 77);
  AddObject(scene, TriangleSoup(10, -1, 1, 0.1f, 78), 10, 0);
  for (const float far : {0.0f, 1e19f, -3e38f}) {
    AddInstance(scene, {1, 0, 0, far, 0, 1, 0, 0, 0, 0, 1, 0}, 0);
  }
  REQUIRE(scene.instances.size() == 3);
  const Bvh bvh = Build(scene);
  CHECK(bvh.max_abs_coord < 3);
}

}  // namespace swell::test
