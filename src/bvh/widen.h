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
  uint32_t left, right;  // 0: none
  // Of a leaf: its reference as BvhNode::child has it, blocks counted from 0; at an end of a part's
  // top also that of a wide node, and the levels of wide nodes from there on.
  uint32_t leaf, depth;
};

// A leaf may have children, too: smaller boxes that may stand for it, see HalveLeaf.
inline bool IsLeaf(const BinaryNode& node) { return node.left == 0 || (node.leaf & kLeafBit) != 0; }

// Node 0 is the root.
struct BinaryTree {
  std::vector<BinaryNode> nodes;
  std::vector<uint32_t> prims;         // of all leaf blocks, one after the other
  std::vector<uint32_t> block_begins;  // first row of prims of every block
  bool cut = false;                    // primitives were: they may be in several blocks
};

// Wide nodes and leaf blocks of a part of the tree, counted from 0, below its binary top.
struct TreePart {
  PageArray<BinaryNode> top;
  PageArray<BvhNode> nodes;
  PageArray<uint32_t> rows;  // where each block begins in them and where the last
                             // ends, then the blocks' primitives
  uint32_t blocks = 0;
  bool cut = false;    // see BinaryTree
  uint32_t share = 0;  // of the scene's primitives, for progress
};

// The tree above its parts.
struct UpperNode {
  Bounds4 box;
  std::unique_ptr<UpperNode> left, right;  // both or none
  std::unique_ptr<TreePart> part;          // if there are none
};

// Widens all but the top of a tree: where parts meet, wide nodes may have children of both.
TreePart Widen(const BinaryTree& tree);

// Puts the parts together and frees them on the way: fills nodes, blocks, depth and max_abs_coord.
void Assemble(std::unique_ptr<UpperNode> root, const Scene& scene, BuildProgress* progress,
              Bvh& bvh);

// A child reference of a tree whose nodes and blocks are put behind so many others.
inline uint32_t MoveChild(uint32_t child, uint32_t nodes, uint32_t blocks) {
  if ((child & kLeafBit) == 0) return child + nodes;
  return (child & kSphereLeafBit) != 0 ? child : child + blocks;
}

// One node without children.
void MakeEmpty(Bvh& bvh);

}  // namespace swell

#endif  // SWELL_BVH_WIDEN_H_
