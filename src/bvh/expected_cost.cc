// A tree in, what a ray is expected to spend in it out.
#include "src/bvh/expected_cost.h"

#include <algorithm>

#include "kernels/records.h"
#include "src/bvh/prim_boxes.h"

namespace swell {
namespace {

double Area(const Box3& box) {
  const double x = double{box.upper[0]} - box.lower[0], y = double{box.upper[1]} - box.lower[1],
               z = double{box.upper[2]} - box.lower[2];
  return x * y + y * z + z * x;
}

}  // namespace

ExpectedCost FindExpectedCost(const Bvh& bvh) {
  ExpectedCost cost;
  Box3 all;
  for (uint32_t i = 0; i < ChildCount(bvh.nodes[0]); ++i) all.Add(ChildBox(bvh.nodes[0], i));
  const double whole = Area(all);
  cost.nodes = 1.0;
  cost.node_count = bvh.nodes.size();
  cost.block_count = bvh.blocks.size();
  for (size_t i = 0; i < bvh.blocks.size(); ++i) {
    const uint32_t(&prims)[kBlockWidth] = bvh.blocks[i].prim;
    cost.reference_count += kBlockWidth - std::count(prims, prims + kBlockWidth, kNoPrim);
  }
  // Every node but the root and every leaf is the child of one node.
  for (size_t n = 0; n < bvh.nodes.size(); ++n) {
    const BvhNode& node = bvh.nodes[n];
    for (uint32_t i = 0; i < ChildCount(node); ++i) {
      const double chance = whole > 0.0 ? Area(ChildBox(node, i)) / whole : 1.0;
      if ((node.child[i] & kLeafBit) == 0) {
        cost.nodes += chance;
        continue;
      }
      const bool is_sphere = (node.child[i] & kSphereLeafBit) != 0;
      const uint32_t count = is_sphere ? 1 : LeafCount(node.child[i]);
      cost.blocks += chance;
      cost.triangles += chance * count;
      cost.block_count += is_sphere ? 1 : 0;
      cost.reference_count += is_sphere ? 1 : 0;
    }
  }
  return cost;
}

}  // namespace swell
