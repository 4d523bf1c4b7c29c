// The leaves of wide nodes in, the blocks that they share out.
#ifndef SWELL_BVH_SHARE_BLOCKS_H_
#define SWELL_BVH_SHARE_BLOCKS_H_

#include <cstdint>
#include <span>
#include <vector>

#include "src/bvh/widen.h"

namespace swell {

// Blocks for the leaves of a tree: those of fewer than kBlockWidth triangles share them. A leaf
// tests its block from the first slot to the last one of its own; what there is of other leaves is
// tested in vain, but is in the scene, so the least hit is the same. A leaf whose triangles are in
// a block already, as those of cut ones may be, takes no slot.
class BlockSharer {
 public:
  explicit BlockSharer(const BinaryTree& tree);

  // The leaves among the node's children get their blocks.
  void Place(BvhNode& node);
  // The same for a leaf by itself.
  void Place(uint32_t& leaf);

  // See TreePart.
  PageArray<uint32_t> Rows() const;
  uint32_t blocks() const { return static_cast<uint32_t>(taken_.size()); }

 private:
  struct Item {
    uint32_t block;  // of the tree
    float urgency;   // chance of a visit, for each triangle: of two in a block this one comes first
  };
  // What is to be in one block.
  struct Bin {
    uint32_t prims[kBlockWidth];
    uint32_t count = 0, items = 0;
    Item item[kBvhWidth];
  };

  std::span<const uint32_t> PrimsOf(uint32_t block) const;
  uint32_t MissingIn(const Bin& bin, uint32_t block) const;
  void Add(const Item& item, Bin& bin) const;
  void PlaceItems(std::span<Item> items);
  void PlaceBin(const Bin& bin);
  bool FindPlace(uint32_t block);
  bool Sit(uint32_t block, uint32_t to);
  uint32_t Moved(uint32_t leaf) const;

  const BinaryTree& tree_;
  std::vector<uint32_t> seat_;   // where each triangle of the tree's blocks is: a row of prims_
  std::vector<uint32_t> prims_;  // kBlockWidth rows a block
  std::vector<uint8_t> taken_;   // slots of each block
  uint32_t open_[kBlockWidth];   // the latest block with so many slots taken, or kNone
  // Rows of prims_ by triangle: the first of each chain, and after each row the next.
  std::vector<uint32_t> chains_, next_;
};

}  // namespace swell

#endif  // SWELL_BVH_SHARE_BLOCKS_H_
