// Cut trees whose margins are taken away: the validator says so, and rays at the cuts of far
// needles lose hits.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "src/bvh/bvh.h"
#include "tests/support/bvh_scenes.h"
#include "tests/support/for_each_target.h"

namespace swell::test {
namespace {

constexpr float kFar = 0x1p20f;
constexpr float kRounding = kFar * 0x1p-24f;
constexpr int kScenes = 400;

// Needles one after the other on a line, `count` of them. The line is far from the origin, and on
// it some axes grow and some shrink: parts on either side of a cut meet at a corner of their boxes,
// and rays from the origin pass there with nothing but margins to either side.
Scene FarLine(uint32_t count, uint32_t seed) {
  Random random(seed);
  const float width = kRounding * static_cast<float>(1 << (seed % 4));
  const uint32_t grows = 1 + seed % 6;
  Float3 at, step;
  for (size_t k = 0; k < 3; ++k) {
    at[k] = random.Uniform(0.3f, 1.0f) * kFar;
    const float length = random.Uniform(0.001f, 0.003f) * kFar / static_cast<float>(count);
    step[k] = (grows >> k) % 2 == 0 ? -length : length;
  }
  Scene scene;
  for (uint32_t i = 0; i < count; ++i) {
    Float3 to, beside;
    for (size_t k = 0; k < 3; ++k) {
      to[k] = at[k] + step[k];
      beside[k] = to[k] + random.Uniform(-width, width);
    }
    AddTriangle(scene, at, to, beside);
    at = to;
  }
  return scene;
}

// The least of its triangles'; the others' are at most 0.3 % larger.
float MarginOf(const Scene& scene) {
  float least = kFar;
  for (size_t i = 0; i < scene.triangle_count(); ++i) {
    const float* p = &scene.positions[9 * i];
    least = std::min(least, std::max({p[0], p[1], p[2], p[3], p[4], p[5]}));
  }
  return least * kBoxMargin;
}

template <class Visit> void ForEachLeaf(Bvh& bvh, const Visit& visit) {
  for (size_t i = 0; i < bvh.nodes.size(); ++i) {
    for (uint32_t slot = 0; slot < ChildCount(bvh.nodes[i]); ++slot) {
      if ((bvh.nodes[i].child[slot] & kLeafBit) != 0) visit(bvh.nodes[i], slot);
    }
  }
}

// A tree that is cut wherever it can be, and then keeps that part of its leaves' margins.
Bvh CutTree(const Scene& scene, float part) {
  Result<Bvh> bvh = BuildBvh(scene, {.most_cuts = 8, .cut_always = true});
  REQUIRE(bvh);
  const float less = (1 - part) * MarginOf(scene);
  ForEachLeaf(*bvh, [&](BvhNode& node, uint32_t slot) {
    for (int k = 0; k < 3; ++k) {
      node.bounds[k][slot] += less;
      node.bounds[k + 3][slot] -= less;
    }
  });
  return std::move(*bvh);
}

// From near the origin to where leaves' boxes end on the line, within a rounding.
std::vector<Ray> RaysAtCuts(const Scene& scene, uint32_t seed) {
  Bvh bvh = CutTree(scene, 1);
  Random random(seed);
  const float* first = scene.positions.data();
  const float* last = first + scene.positions.size() - 6;
  std::vector<Ray> rays;
  ForEachLeaf(bvh, [&](const BvhNode& node, uint32_t slot) {
    for (int i = 0; i < 12; ++i) {
      const int axis = i % 3;
      const double plane = double{node.bounds[axis + 3][slot]} - MarginOf(scene);
      const double along = (plane - first[axis]) / (double{last[axis]} - first[axis]);
      if (!(along > 0 && along < 1)) continue;
      const Float3 from = random.Point(-1, 1), noise = random.Point(-kRounding, kRounding);
      Float3 dir;
      for (size_t k = 0; k < 3; ++k) {
        const double to = first[k] + along * (double{last[k]} - first[k]);
        dir[k] = static_cast<float>(to + noise[k] - from[k]);
      }
      rays.push_back({from, dir});
    }
  });
  return rays;
}

struct Lost {
  size_t hits = 0, lost = 0;
};

// Of all scenes, by target, with that part of the margins.
std::map<std::string, Lost> FindLost(float part) {
  std::map<std::string, Lost> all;
  for (uint32_t seed = 0; seed < kScenes; ++seed) {
    const Scene scene = FarLine(64, seed);
    const RayTable rays(RaysAtCuts(scene, seed + kScenes));
    const Result<Bvh> whole = BuildBvh(scene, {.most_cuts = 0});
    REQUIRE(whole);
    const Bvh cut = CutTree(scene, part);
    ForEachTarget([&](const char* target, Width width) {
      for (const Traversal traversal : {Traversal::kPacket, Traversal::kSingle}) {
        const auto expected = Intersect(*whole, width, traversal, rays);
        const auto got = Intersect(cut, width, traversal, rays);
        Lost& sum = all[NameRun(target, width, traversal)];
        for (size_t i = 0; i < got.size(); ++i) {
          sum.hits += expected[i].prim != kNoPrim;
          sum.lost += !SameHit(got[i], expected[i]);
        }
      }
    });
  }
  return all;
}

}  // namespace

TEST_CASE(
    "cut margins: ValidateBvh accepts whole ones, and reports three quarters of them and none") {
  for (uint32_t seed = 0; seed < 50; ++seed) {
    const Scene scene = FarLine(64, seed);
    REQUIRE(CutTree(scene, 1).blocks.size() > 4);
    CHECK(ValidateBvh(CutTree(scene, 1), scene) == "");
    for (const float part : {0.75f, 0.5f, 0.0f})
      CHECK(ValidateBvh(CutTree(scene, part), scene) != "");
  }
}

TEST_CASE("cut margins: with them rays at cuts lose no hit, without them some") {
  for (const auto& [run, sum] : FindLost(1)) {
    INFO(run);
    CHECK(sum.hits > 4000);
    CHECK(sum.lost == 0);
  }
  // Only single rays: a bundle that has one triangle of a block left does not ask for its box.
  for (const auto& [run, sum] : FindLost(0)) {
    if (run.find("single") == std::string::npos) continue;
    INFO(run);
    CHECK(sum.lost > 20);
  }
}

}  // namespace swell::test
