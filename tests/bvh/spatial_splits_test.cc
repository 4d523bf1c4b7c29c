// Trees whose triangles are cut as often as can be, against trees that cut none and against every
// triangle tested.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "src/bvh/bvh.h"
#include "src/bvh/expected_cost.h"
#include "tests/support/bvh_scenes.h"
#include "tests/support/count_different.h"
#include "tests/support/for_each_target.h"

namespace swell::test {
namespace {

constexpr Traversal kTraversals[] = {Traversal::kPacket, Traversal::kSingle};

Bvh Build(const Scene& scene, const BuildOptions& options) {
  Result<Bvh> bvh = BuildBvh(scene, options);
  REQUIRE(bvh);
  return std::move(*bvh);
}

BuildOptions CutAlways(float most_cuts) { return {.most_cuts = most_cuts, .cut_always = true}; }

// From and to points of one triangle's plane, near and far: rays that see it edge-on, where
// distances are the least certain.
std::vector<Ray> RaysInPlanes(const Scene& scene, size_t count, uint32_t seed) {
  Random random(seed);
  std::vector<Ray> rays;
  while (rays.size() < count) {
    const size_t triangle = random.Bits() % scene.triangle_count();
    const auto point = [&](float reach) {
      const float u = random.Uniform(-reach, reach), v = random.Uniform(-reach, reach);
      Float3 p;
      for (size_t k = 0; k < 3; ++k) {
        const auto at = [&](size_t i) {
          return scene.positions[3 * size_t{scene.indices[3 * triangle + i]} + k];
        };
        p[k] = (1 - u - v) * at(0) + u * at(1) + v * at(2);
      }
      return p;
    };
    const Float3 from = point(random.Bits() % 2 == 0 ? 1.0f : 30.0f), to = point(1);
    rays.push_back({from, {to[0] - from[0], to[1] - from[1], to[2] - from[2]}});
  }
  return rays;
}

// Long thin triangles in all directions, many of them crossing.
Scene Needles(uint32_t count, float width, uint32_t seed) {
  Random random(seed);
  Scene scene;
  for (uint32_t i = 0; i < count; ++i) {
    const Float3 a = random.Point(-1, 1), b = random.Point(-1, 1);
    const Float3 shift = random.Point(-width, width);
    AddTriangle(scene, a, b, {b[0] + shift[0], b[1] + shift[1], b[2] + shift[2]});
  }
  return scene;
}

// Thin leaning boxes without ends, on a square.
Scene Pillars(uint32_t count, uint32_t seed) {
  Random random(seed);
  Scene scene;
  for (uint32_t i = 0; i < count; ++i) {
    const float x = random.Uniform(-9.5f, 9.5f), z = random.Uniform(-9.5f, 9.5f);
    const float height = random.Uniform(0.1f, 4.0f), half = random.Uniform(0.01f, 0.05f);
    const float lean_x = random.Uniform(-0.4f, 0.4f), lean_z = random.Uniform(-0.4f, 0.4f);
    const auto point = [&](float dx, float dz, float h) -> Float3 {
      return {x + dx * half + lean_x * h, h, z + dz * half + lean_z * h};
    };
    const float corners[5][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}};
    for (int side = 0; side < 4; ++side) {
      const auto& [ax, az] = corners[side];
      const auto& [bx, bz] = corners[side + 1];
      AddTriangle(scene, point(ax, az, 0), point(bx, bz, 0), point(bx, bz, height));
      AddTriangle(scene, point(ax, az, 0), point(bx, bz, height), point(ax, az, height));
    }
  }
  return scene;
}

std::vector<NamedScene> CutScenes() {
  std::vector<NamedScene> scenes = AllScenes();
  for (const float width : {1e-1f, 1e-3f, 1e-5f, 1e-7f}) {
    scenes.push_back({"needles " + std::to_string(width), Needles(300, width, 30), -1, 1});
  }
  scenes.push_back({"pillars", Pillars(200, 34), -10, 10});
  return scenes;
}

std::vector<uint32_t*> TriangleLeaves(Bvh& bvh) {
  std::vector<uint32_t*> leaves;
  for (size_t i = 0; i < bvh.nodes.size(); ++i) {
    for (uint32_t k = 0; k < ChildCount(bvh.nodes[i]); ++k) {
      uint32_t& child = bvh.nodes[i].child[k];
      if ((child & kLeafBit) != 0 && (child & kSphereLeafBit) == 0) leaves.push_back(&child);
    }
  }
  return leaves;
}

// Rays of all kinds through a scene.
std::vector<Ray> AllRays(const NamedScene& named, size_t count, uint32_t seed) {
  std::vector<Ray> rays = RaysFor(named, count, seed);
  if (named.scene.triangle_count() == 0) return rays;
  const std::vector<Ray> more = RaysInPlanes(named.scene, count, seed + 1);
  rays.insert(rays.end(), more.begin(), more.end());
  return rays;
}

// Calls check(hits) for every traversal of every target.
template <class Check> void ForEachRun(const Bvh& bvh, const RayTable& rays, const Check& check) {
  ForEachTarget([&](const char* target, Width width) {
    for (const Traversal traversal : kTraversals) {
      INFO(NameRun(target, width, traversal));
      check(Intersect(bvh, width, traversal, rays), std::string(target));
    }
  });
}

}  // namespace

TEST_CASE("spatial splits: every part of every triangle is in a leaf") {
  for (const NamedScene& named : CutScenes()) {
    INFO(named.name);
    const Bvh bvh = Build(named.scene, CutAlways(8));
    CHECK(ValidateBvh(bvh, named.scene) == "");
  }
}

TEST_CASE("spatial splits: the scenes of these tests are cut, and triangles are in many leaves") {
  size_t cut_scenes = 0;
  for (const NamedScene& named : CutScenes()) {
    INFO(named.name);
    Bvh cut = Build(named.scene, CutAlways(8)), whole = Build(named.scene, {.most_cuts = 0});
    cut_scenes += TriangleLeaves(cut).size() > 2 * TriangleLeaves(whole).size();
  }
  CHECK(cut_scenes >= 10);
}

TEST_CASE("spatial splits: among leaning pillars they save a tenth of the expected cost") {
  const Scene scene = Pillars(25000, 31);
  const Bvh cut = Build(scene, {}), whole = Build(scene, {.most_cuts = 0});
  CHECK(ValidateBvh(cut, scene) == "");
  CHECK(FindExpectedCost(cut).Total(1) < 0.9 * FindExpectedCost(whole).Total(1));
}

TEST_CASE("spatial splits: pillars among long slivers take at most 75 bytes a triangle") {
  Scene scene = Pillars(20000, 31);
  Random random(35);
  for (int i = 0; i < 20000; ++i) {
    const Float3 a = {random.Uniform(-9, 9), random.Uniform(1, 3), random.Uniform(-9, 9)};
    const Float3 along = random.Point(-1, 1);
    const Float3 b = {a[0] + along[0], a[1] + along[1], a[2] + along[2]};
    AddTriangle(scene, a, b, {b[0], b[1] + 1e-3f, b[2]});
  }
  const Bvh bvh = Build(scene, {});
  CHECK(ValidateBvh(bvh, scene) == "");
  CHECK(FindExpectedCost(bvh).reference_count > 1.3 * scene.triangle_count());
  CHECK(bvh.bytes() <= 75 * scene.triangle_count());
}

TEST_CASE("spatial splits: leaves share blocks, which are nearly full") {
  const Scene scene = Pillars(5000, 36);
  Bvh bvh = Build(scene, CutAlways(1));
  CHECK(ValidateBvh(bvh, scene) == "");
  CHECK(TriangleLeaves(bvh).size() > 1.5 * bvh.blocks.size());
  CHECK(FindExpectedCost(bvh).reference_count > 0.9 * kBlockWidth * bvh.blocks.size());
}

TEST_CASE("spatial splits: of a mesh they leave all but a twentieth whole") {
  const Scene scene = ClosedMesh(6, 1, {0, 0, 0}, 33);
  const ExpectedCost cut = FindExpectedCost(Build(scene, {}));
  const ExpectedCost whole = FindExpectedCost(Build(scene, {.most_cuts = 0}));
  CHECK(whole.reference_count == scene.triangle_count());
  CHECK(cut.reference_count <= 1.05 * scene.triangle_count());
  CHECK(cut.Total(1) <= 1.01 * whole.Total(1));
}

TEST_CASE("spatial splits: ValidateBvh reports a part that is not covered") {
  const Scene scene = Needles(300, 1e-3f, 32);
  Bvh bvh = Build(scene, CutAlways(4));
  for (size_t i = 0; i < bvh.nodes.size(); ++i) {
    for (uint32_t k = 0; k < ChildCount(bvh.nodes[i]); ++k) {
      if ((bvh.nodes[i].child[k] & kLeafBit) == 0) continue;
      bvh.nodes[i].bounds[0][k] += 0.5f * (bvh.nodes[i].bounds[3][k] - bvh.nodes[i].bounds[0][k]);
      CHECK(ValidateBvh(bvh, scene) != "");
      return;
    }
  }
}

TEST_CASE("spatial splits: ValidateBvh reports slots that no leaf reaches, or a triangle twice") {
  const Scene scene = Pillars(500, 37);
  const auto damage = [&](const auto& how) {
    Bvh bvh = Build(scene, CutAlways(1));
    how(bvh);
    return ValidateBvh(bvh, scene);
  };
  CHECK(damage([](Bvh&) {}) == "");
  constexpr uint32_t kOne = 1u << kBlockCountShift;
  CHECK(damage([](Bvh& bvh) {  // one slot less for all leaves of a full block
          const uint32_t full = (kBlockWidth - 1) << kBlockCountShift;
          const auto leaves = TriangleLeaves(bvh);
          const auto ends = [&](const uint32_t* leaf) { return LeafCount(*leaf) == kBlockWidth; };
          const auto first = std::find_if(leaves.begin(), leaves.end(), ends);
          REQUIRE(first != leaves.end());
          const uint32_t block = LeafBlock(**first);
          for (uint32_t* leaf : leaves) {
            if (*leaf == (kLeafBit | full | block)) *leaf -= kOne;
          }
        }) != "");
  CHECK(damage([](Bvh& bvh) {  // one slot more than are taken
          for (uint32_t* leaf : TriangleLeaves(bvh)) {
            const uint32_t count = LeafCount(*leaf);
            if (count == kBlockWidth || bvh.blocks[LeafBlock(*leaf)].prim[count] != kNoPrim)
              continue;
            *leaf += kOne;
            return;
          }
          FAIL("every block is full");
        }) != "");
  CHECK(damage([](Bvh& bvh) {
          TriangleBlock& block = bvh.blocks[0];
          block.prim[1] = block.prim[0];
          for (auto& vertex : block.vertex) {
            for (auto& axis : vertex) axis[1] = axis[0];
          }
        }) != "");
}

TEST_CASE("spatial splits: hits are the same to the bit as without them") {
  for (const NamedScene& named : CutScenes()) {
    INFO(named.name);
    const Bvh whole = Build(named.scene, {.most_cuts = 0});
    const RayTable rays(AllRays(named, 2000, 200));
    std::map<std::string, std::vector<HitFields<Row>>> expected;
    ForEachRun(whole, rays, [&](const auto& hits, const std::string& target) {
      const auto& first = expected.try_emplace(target, hits).first->second;
      CHECK(CountDifferent(hits, first) == 0);
    });
    for (const float most_cuts : {0.5f, 8.0f}) {
      INFO("cuts: ", most_cuts);
      ForEachRun(Build(named.scene, CutAlways(most_cuts)), rays,
                 [&](const auto& hits, const std::string& target) {
                   CHECK(CountDifferent(hits, expected[target]) == 0);
                 });
    }
  }
}

TEST_CASE("spatial splits: hits are those of the reference to the bit") {
  for (const NamedScene& named : CutScenes()) {
    INFO(named.name);
    const Bvh bvh = Build(named.scene, CutAlways(8));
    std::vector<Ray> rays;
    std::vector<HitFields<Row>> expected;
    for (const Ray& ray : AllRays(named, 500, 201)) {
      if (!std::isfinite(ray.org[0] + ray.org[1] + ray.org[2] + ray.dir[0] + ray.dir[1] +
                         ray.dir[2])) {
        continue;
      }
      rays.push_back(ray);
      expected.push_back(reference::ClosestHit(named.scene, ray));
    }
    ForEachRun(bvh, RayTable(rays), [&](const auto& hits, const std::string& target) {
      if (target != "sse4" && target != "scalar") CHECK(CountDifferent(hits, expected) == 0);
    });
  }
}

namespace {

// The children of every node the other way round.
void TurnSlots(Bvh& bvh) {
  for (size_t n = 0; n < bvh.nodes.size(); ++n) {
    BvhNode& node = bvh.nodes[n];
    const uint32_t count = ChildCount(node);
    for (auto& plane : node.bounds) std::reverse(plane, plane + count);
    std::reverse(node.child, node.child + count);
    for (uint32_t& order : node.order) {
      uint32_t turned = count << kChildCountShift;
      for (uint32_t i = 0; i < kBvhWidth; ++i) {
        const uint32_t slot = (order >> (kOrderBits * i)) % kBvhWidth;
        turned |= (slot < count ? count - 1 - slot : slot) << (kOrderBits * i);
      }
      order = turned;
    }
  }
}

uint64_t TestsOfAnyHit(const Bvh& bvh, const RayTable& rays) {
  LaneUse use;
  Occluded(bvh, Width::kWide, Traversal::kSingle, rays, std::vector(rays.count, INFINITY), &use);
  return use.issued;
}

}  // namespace

TEST_CASE("spatial splits: any hit is found sooner in the slots' order than the other way round") {
  const Scene scene = Pillars(3000, 202);
  Random random(203);
  std::vector<Ray> list;
  for (int i = 0; i < 2000; ++i) {
    list.push_back({{random.Uniform(-9, 9), random.Uniform(0, 1), random.Uniform(-9, 9)},
                    {random.Uniform(-1, 1), random.Uniform(0, 0.1f), random.Uniform(-1, 1)}});
  }
  const RayTable rays(list);
  Bvh bvh = Build(scene, {});
  const uint64_t tests = TestsOfAnyHit(bvh, rays);
  TurnSlots(bvh);
  REQUIRE(ValidateBvh(bvh, scene) == "");
  CHECK(static_cast<double>(tests) < 0.9 * static_cast<double>(TestsOfAnyHit(bvh, rays)));
}

}  // namespace swell::test
