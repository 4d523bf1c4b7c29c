// The children of nodes in, sorted by how likely they stop a ray for what they cost.
#include "src/bvh/order_slots.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "src/bvh/prim_boxes.h"

namespace swell {
namespace {

float TriangleArea(const TriangleBlock& block, uint32_t i) {
  float ab[3], ac[3];
  for (int k = 0; k < 3; ++k) {
    ab[k] = block.vertex[1][k][i] - block.vertex[0][k][i];
    ac[k] = block.vertex[2][k][i] - block.vertex[0][k][i];
  }
  const float x = ab[1] * ac[2] - ab[2] * ac[1], y = ab[2] * ac[0] - ab[0] * ac[2],
              z = ab[0] * ac[1] - ab[1] * ac[0];
  return 0.5f * std::sqrt(x * x + y * y + z * z);
}

// At most 1; 1 also where it cannot be computed.
float ShareOf(float part, float whole) {
  const float share = part / whole;
  return share < 1.0f ? share : 1.0f;
}

void TakeSlots(const BvhNode& from, const uint32_t (&slots)[kBvhWidth], BvhNode& to) {
  uint32_t moved[kBvhWidth];
  for (uint32_t i = 0; i < kBvhWidth; ++i) {
    for (int k = 0; k < 6; ++k) to.bounds[k][i] = from.bounds[k][slots[i]];
    to.child[i] = from.child[slots[i]];
    moved[slots[i]] = i;
  }
  for (uint32_t octant = 0; octant < 8; ++octant) {
    uint32_t order = ChildCount(from) << kChildCountShift;
    for (uint32_t i = 0; i < kBvhWidth; ++i) {
      const uint32_t slot = (from.order[octant] >> (kOrderBits * i)) % kBvhWidth;
      order |= moved[slot] << (kOrderBits * i);
    }
    to.order[octant] = order;
  }
}

}  // namespace

// A random ray through a convex box meets a triangle inside with the chance that the triangle's
// area has of half the box' surface. Of a triangle that was cut the box' own is taken at most.
SlotOrder::Subtree SlotOrder::OfLeaf(uint32_t child, float half_area) const {
  if ((child & kSphereLeafBit) != 0) return {0.5f, 1.0f};
  float area = 0.0f;
  for (uint32_t i = 0; i < LeafCount(child); ++i) {
    area += std::min(TriangleArea(bvh_.blocks[LeafBlock(child)], i), half_area);
  }
  const float hits = area / half_area;  // on the mean
  return {hits < kBlockWidth ? -std::expm1(-hits) : 1.0f, 1.0f};
}

void SlotOrder::Add(uint32_t first, uint32_t count, bool sort) {
  for (uint32_t n = first + count; n-- > first;) {
    BvhNode& node = bvh_.nodes[n];
    const uint32_t children = ChildCount(node);
    Box3 all;
    for (uint32_t i = 0; i < children; ++i) all.Add(ChildBox(node, i));
    float free = 1.0f, cost = 1.0f, worth[kBvhWidth];
    for (uint32_t i = 0; i < children; ++i) {
      const uint32_t child = node.child[i];
      const float half_area = ChildBox(node, i).HalfArea();
      const Subtree below = (child & kLeafBit) != 0 ? OfLeaf(child, half_area) : of_node_[child];
      const float enters = ShareOf(half_area, all.HalfArea());
      free *= 1.0f - enters * below.chance;
      cost += enters * below.cost;
      worth[i] = below.chance / below.cost;
    }
    of_node_[n] = {1.0f - free, cost};
    if (!sort) continue;
    uint32_t slots[kBvhWidth];
    std::iota(slots, slots + kBvhWidth, 0u);
    std::stable_sort(slots, slots + children,
                     [&](uint32_t a, uint32_t b) { return worth[a] < worth[b]; });
    TakeSlots(BvhNode(node), slots, node);
  }
}

}  // namespace swell
