// Boxes of primitives in, a binary tree by the surface area heuristic out.
#ifndef SWELL_BVH_BUILD_SAH_H_
#define SWELL_BVH_BUILD_SAH_H_

#include <cstdint>

#include "src/bvh/bvh.h"
#include "src/bvh/prim_boxes.h"

namespace swell {

// A primitive on its way into the tree.
struct BuildPrim {
  Box3 box;
  uint32_t prim;       // instances come after all primitives
  uint32_t is_sphere;  // or an instance: a leaf of its own
};

// The node of primitives [first, first + count). A tree of n primitives takes the nodes [0, 2 n -
// 1): the left child of node i is i + 1, and its subtree takes 2 m - 1 nodes, m its primitives.
struct BinaryNode {
  Box3 box;
  uint32_t first, count;
  uint32_t right;  // 0: a leaf, which fits one block or is one sphere or instance
};

struct BinaryTree {
  PageArray<BinaryNode> nodes;
  PageArray<BuildPrim> prims;  // in the order of the leaves
};

// Levels of a binary tree, which bounds the levels of the wide one.
inline constexpr uint32_t kMaxBinaryDepth = kMaxBvhDepth;

// `prims` must not be empty; its content is used up.
BinaryTree BuildSah(PageArray<BuildPrim> prims, const BuildOptions& options);

}  // namespace swell

#endif  // SWELL_BVH_BUILD_SAH_H_
