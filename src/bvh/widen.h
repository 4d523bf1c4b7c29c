// Binary trees in, wide nodes and leaf blocks out.
#ifndef SWELL_BVH_WIDEN_H_
#define SWELL_BVH_WIDEN_H_

#include <cstdint>
#include <memory>
#include <vector>

#include "src/bvh/bounds4.h"
#include "src/bvh/bvh.h"

namespace swell {

struct BinaryNode {
  Bounds4 box;
  uint32_t left, right;  // 0: a leaf
  uint32_t leaf;         // its reference as BvhNode::child has it, blocks counted from 0
};

// Node 0 is the root.
struct BinaryTree {
  std::vector<BinaryNode> nodes;
  std::vector<uint32_t> prims;         // of all leaf blocks, one after the other
  std::vector<uint32_t> block_begins;  // first row of prims of every block
};

// Wide nodes and leaf blocks of a part of the tree, counted from 0.
struct TreePart {
  PageArray<BvhNode> nodes;
  PageArray<uint32_t> prims, block_begins;  // as BinaryTree has them
  uint32_t share = 0;                       // of the scene's primitives, for progress
};

// The upper levels of the tree as long as they are binary.
struct UpperNode {
  Bounds4 box;
  std::unique_ptr<UpperNode> left, right;  // both or none
  std::unique_ptr<TreePart> part;          // what the ends below refer to
  // If an end:
  uint32_t root = kEmptyChild;  // as BvhNode::child has it, within the part
  uint32_t depth = 0;           // levels of wide nodes from there on
};

// Widens all but the top of a tree, which becomes `top`: where the parts meet, wide nodes may still
// have children of both.
void Widen(const BinaryTree& tree, UpperNode& top);

// Puts the parts together: fills nodes, blocks, depth and max_abs_coord.
void Assemble(UpperNode& root, const Scene& scene, BuildProgress* progress, Bvh& bvh);

// A child reference of a tree whose nodes and blocks are put behind so many others.
inline uint32_t MoveChild(uint32_t child, uint32_t nodes, uint32_t blocks) {
  if ((child & kLeafBit) == 0) return child + nodes;
  return (child & kSphereLeafBit) != 0 ? child : child + blocks;
}

// One node without children.
void MakeEmpty(Bvh& bvh);

}  // namespace swell

#endif  // SWELL_BVH_WIDEN_H_
