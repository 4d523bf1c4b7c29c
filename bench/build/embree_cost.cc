// A scene in, the expected cost of the tree that Embree's general builder makes of it out.
#include "bench/build/embree_cost.h"

#include <algorithm>
#include <vector>

#include "src/bvh/spatial_split.h"

namespace swell::bench {
namespace {

struct Node {
  uint32_t child_count;  // 0: a leaf
  uint32_t triangles;
  RTCBounds bounds[kBvhWidth];
  Node* children[kBvhWidth];
};

Box3 ToBox(const RTCBounds& b) {
  return {{b.lower_x, b.lower_y, b.lower_z}, {b.upper_x, b.upper_y, b.upper_z}};
}

RTCBounds ToBounds(const Box3& box, const RTCBuildPrimitive& within) {
  return {std::max(box.lower[0], within.lower_x), std::max(box.lower[1], within.lower_y),
          std::max(box.lower[2], within.lower_z), 0,
          std::min(box.upper[0], within.upper_x), std::min(box.upper[1], within.upper_y),
          std::min(box.upper[2], within.upper_z), 0};
}

void* MakeNode(RTCThreadLocalAllocator memory, unsigned child_count, void*) {
  Node* node = static_cast<Node*>(rtcThreadLocalAlloc(memory, sizeof(Node), 16));
  node->child_count = child_count;
  return node;
}
void* MakeLeaf(RTCThreadLocalAllocator memory, const RTCBuildPrimitive*, size_t count, void*) {
  Node* node = static_cast<Node*>(rtcThreadLocalAlloc(memory, sizeof(Node), 16));
  node->child_count = 0;
  node->triangles = static_cast<uint32_t>(count);
  return node;
}
void SetChildren(void* node, void** children, unsigned count, void*) {
  for (unsigned i = 0; i < count; ++i) {
    static_cast<Node*>(node)->children[i] = static_cast<Node*>(children[i]);
  }
}
void SetBounds(void* node, const RTCBounds** bounds, unsigned count, void*) {
  for (unsigned i = 0; i < count; ++i) static_cast<Node*>(node)->bounds[i] = *bounds[i];
}
void SplitPrimitive(const RTCBuildPrimitive* prim, unsigned axis, float plane, RTCBounds* left,
                    RTCBounds* right, void* scene) {
  const CutParts parts =
      CutTriangle(*static_cast<const Scene*>(scene), prim->primID, static_cast<int>(axis), plane);
  *left = ToBounds(parts.left.ToBox3(), *prim);
  *right = ToBounds(parts.right.ToBox3(), *prim);
}

void Walk(const Node& node, double chance, double whole, ExpectedCost& cost) {
  if (node.child_count == 0) {
    const uint32_t blocks = (node.triangles + kBlockWidth - 1) / kBlockWidth;
    cost.blocks += chance * blocks;
    cost.triangles += chance * node.triangles;
    cost.block_count += blocks;
    cost.reference_count += node.triangles;
    return;
  }
  ++cost.node_count;
  cost.nodes += chance;
  for (uint32_t i = 0; i < node.child_count; ++i) {
    Walk(*node.children[i], ToBox(node.bounds[i]).HalfArea() / whole, whole, cost);
  }
}

ExpectedCost CostOf(RTCDevice device, const Scene& scene, RTCBuildQuality quality,
                    uint32_t leaf_size) {
  const size_t count = scene.triangle_count();
  std::vector<RTCBuildPrimitive> prims(2 * count);
  Box3 all;
  for (uint32_t i = 0; i < count; ++i) {
    const Box3 box = TriangleBox(scene, i);
    all.Add(box);
    prims[i] = {box.lower[0], box.lower[1], box.lower[2], 0,
                box.upper[0], box.upper[1], box.upper[2], i};
  }
  const RTCBVH bvh = rtcNewBVH(device);
  RTCBuildArguments arguments = rtcDefaultBuildArguments();
  arguments.buildQuality = quality;
  arguments.maxBranchingFactor = kBvhWidth;
  arguments.sahBlockSize = leaf_size;
  arguments.minLeafSize = leaf_size;
  arguments.bvh = bvh;
  arguments.primitives = prims.data();
  arguments.primitiveCount = count;
  arguments.primitiveArrayCapacity = prims.size();
  arguments.createNode = MakeNode;
  arguments.createLeaf = MakeLeaf;
  arguments.setNodeChildren = SetChildren;
  arguments.setNodeBounds = SetBounds;
  arguments.splitPrimitive = SplitPrimitive;
  arguments.userPtr = const_cast<Scene*>(&scene);
  ExpectedCost cost;
  const void* root = rtcBuildBVH(&arguments);
  if (root != nullptr) Walk(*static_cast<const Node*>(root), 1.0, all.HalfArea(), cost);
  rtcReleaseBVH(bvh);
  return cost;
}

}  // namespace

ExpectedCost FindEmbreeCost(RTCDevice device, const Scene& scene, RTCBuildQuality quality) {
  const ExpectedCost four = CostOf(device, scene, quality, 4);
  const ExpectedCost eight = CostOf(device, scene, quality, kBlockWidth);
  return four.Total(kBlockCost) < eight.Total(kBlockCost) ? four : eight;
}

}  // namespace swell::bench
