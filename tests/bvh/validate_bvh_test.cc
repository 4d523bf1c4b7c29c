// ValidateBvh on trees that are wrong in one place.
#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "src/bvh/bvh.h"
#include "tests/support/bvh_scenes.h"

namespace swell::test {
namespace {

Bvh Build(const Scene& scene) {
  Result<Bvh> bvh = BuildBvh(scene);
  REQUIRE(bvh);
  REQUIRE(ValidateBvh(*bvh, scene) == "");
  return std::move(*bvh);
}

// What the validator says of the scene's tree after `harm`.
std::string SaidOf(const Scene& scene, const std::function<void(Bvh&)>& harm) {
  Bvh bvh = Build(scene);
  harm(bvh);
  return ValidateBvh(bvh, scene);
}

// The first node with less than all children.
BvhNode& NodeWithEmptySlot(Bvh& bvh) {
  size_t i = 0;
  while (ChildCount(bvh.nodes[i]) == kBvhWidth) ++i;
  return bvh.nodes[i];
}

// The first block with less than all rows.
TriangleBlock& BlockWithEmptyRow(Bvh& bvh) {
  size_t i = 0;
  while (bvh.blocks[i].prim[kBlockWidth - 1] != kNoPrim) ++i;
  return bvh.blocks[i];
}

}  // namespace

TEST_CASE("ValidateBvh: reports a lost instance, its box too small and a tree of another object") {
  Scene scene;
  for (uint32_t i = 0; i < 2; ++i) {
    AddObject(scene, TriangleSoup(20, -1, 1, 0.1f, 79 + i), 20, 0);
    for (int k = 0; k < 10; ++k) {
      AddInstance(scene, {1, 0, 0, static_cast<float>(k), 0, 1, 0, 0, 0, 0, 1, 0}, i);
    }
  }
  Bvh lost = Build(scene);
  for (uint32_t& child : lost.nodes[0].child) {
    if ((child & kInstanceLeafBit) != 0 && child != kEmptyChild) child ^= 1;
  }
  CHECK(ValidateBvh(lost, scene) != "");
  Bvh small = Build(scene);
  small.nodes[0].bounds[0][0] += 0.01f;
  CHECK(ValidateBvh(small, scene) != "");
  Bvh exchanged = Build(scene);
  std::swap(exchanged.objects[0].root, exchanged.objects[1].root);
  CHECK(ValidateBvh(exchanged, scene) != "");
}

TEST_CASE("ValidateBvh: reports a lost primitive, a box too small and a wrong depth") {
  const Scene scene = TriangleSoup(100, -1, 1, 0.1f, 73);
  Bvh lost = Build(scene);
  lost.blocks[0].prim[0] = lost.blocks[1].prim[0];
  CHECK(ValidateBvh(lost, scene) != "");
  Bvh small = Build(scene);
  small.nodes[0].bounds[0][0] += 0.01f;
  CHECK(ValidateBvh(small, scene) != "");
  Bvh deep = Build(scene);
  deep.depth += 1;
  CHECK(ValidateBvh(deep, scene) != "");
}

TEST_CASE("ValidateBvh: reports another box of a sphere, and fewer spheres or triangles") {
  Scene scene = TriangleSoup(100, -1, 1, 0.1f, 73);
  for (int i = 0; i < 5; ++i) AddSphere(scene, {static_cast<float>(i), 0, 0}, 0.3f);
  CHECK(SaidOf(scene, [](Bvh& bvh) { bvh.sphere_boxes[8] = 0; }) != "");
  CHECK(SaidOf(scene, [](Bvh& bvh) { bvh.sphere_boxes.pop_back(); }) != "");
  CHECK(SaidOf(scene, [](Bvh& bvh) { --bvh.sphere_count; }) != "");
  CHECK(SaidOf(scene, [](Bvh& bvh) { --bvh.triangle_count; }) != "");
  CHECK(SaidOf(scene, [](Bvh& bvh) { bvh.spheres = nullptr; }) != "");
}

TEST_CASE(
    "ValidateBvh: reports boxes beyond the largest coordinate, of no size, and of no number") {
  const Scene scene = TriangleSoup(100, -1, 1, 0.1f, 73);
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  CHECK(SaidOf(scene, [](Bvh& bvh) { bvh.max_abs_coord *= 0.99f; }) != "");
  CHECK(SaidOf(scene, [](Bvh& bvh) { bvh.max_abs_coord = NAN; }) != "");
  for (int k = 0; k < 3; ++k) {
    CHECK(SaidOf(scene, [&](Bvh& bvh) { bvh.nodes[0].bounds[k][0] = NAN; }) != "");
    CHECK(SaidOf(scene, [&](Bvh& bvh) { bvh.nodes[0].bounds[k][0] = -kInfinity; }) != "");
    CHECK(SaidOf(scene, [&](Bvh& bvh) { bvh.nodes[0].bounds[k + 3][0] = kInfinity; }) != "");
    CHECK(SaidOf(scene, [&](Bvh& bvh) { bvh.nodes[0].bounds[k + 3][0] = -kInfinity; }) != "");
  }
}

TEST_CASE("ValidateBvh: reports an empty slot that rays could enter, and orders that miss a slot") {
  const Scene scene = TriangleSoup(100, -1, 1, 0.1f, 73);
  CHECK(SaidOf(scene, [](Bvh& bvh) {
          for (auto& column : NodeWithEmptySlot(bvh).bounds) column[kBvhWidth - 1] = 0;
        }) != "");
  CHECK(SaidOf(scene, [](Bvh& bvh) { NodeWithEmptySlot(bvh).child[kBvhWidth - 1] = 0; }) != "");
  for (int octant = 0; octant < 8; ++octant) {
    CHECK(SaidOf(scene, [&](Bvh& bvh) { bvh.nodes[0].order[octant] ^= 1; }) != "");
    CHECK(SaidOf(scene, [&](Bvh& bvh) { bvh.nodes[0].order[octant] += 1u << 24; }) != "");
  }
}

TEST_CASE("ValidateBvh: reports other vertices, and rows that a ray could hit and must not") {
  Scene scene = TriangleSoup(100, -1, 1, 0.1f, 73);
  CHECK(SaidOf(scene, [](Bvh& bvh) { bvh.blocks[0].vertex[1][2][0] += 1e-6f; }) != "");
  CHECK(SaidOf(scene, [](Bvh& bvh) { BlockWithEmptyRow(bvh).vertex[0][0][kBlockWidth - 1] = 1; }) !=
        "");
  for (float& x : scene.positions) x = INFINITY;
  CHECK(SaidOf(scene, [](Bvh& bvh) { bvh.blocks[0].vertex[0][0][0] = INFINITY; }) != "");
  CHECK(SaidOf(scene, [](Bvh& bvh) { bvh.blocks[0].vertex[2][1][0] = 0.5f; }) != "");
}

TEST_CASE("ValidateBvh: reports nodes and blocks that are reached twice or never") {
  const Scene scene = TriangleSoup(1000, -1, 1, 0.1f, 73);
  const auto first_inner = [](const BvhNode& node) {
    uint32_t i = 0;
    while ((node.child[i] & kLeafBit) != 0) ++i;
    return i;
  };
  CHECK(SaidOf(scene, [&](Bvh& bvh) {
          bvh.nodes[0].child[first_inner(bvh.nodes[0])] = 0;  // a ring
        }) != "");
  CHECK(SaidOf(scene, [&](Bvh& bvh) {
          const uint32_t slot = first_inner(bvh.nodes[0]);
          bvh.nodes[0].child[slot] = bvh.nodes[0].child[slot + 1];
        }) != "");
  CHECK(SaidOf(scene, [&](Bvh& bvh) {
          bvh.nodes[0].child[first_inner(bvh.nodes[0])] = static_cast<uint32_t>(bvh.nodes.size());
        }) != "");
}

}  // namespace swell::test
