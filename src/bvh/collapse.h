// A binary tree in, which of its nodes become the children of wide nodes out.
#ifndef SWELL_BVH_COLLAPSE_H_
#define SWELL_BVH_COLLAPSE_H_

#include <cstdint>
#include <vector>

#include "src/bvh/widen.h"

namespace swell {

// For every node of a binary tree the least expected cost of its subtree below i roots, i at most
// kBvhWidth, in half areas. After Ylitie, Karras and Laine 2017, "Efficient Incoherent Ray
// Traversal on GPUs Through Compressed Wide BVHs", section 3.1.
class Collapse {
 public:
  explicit Collapse(const BinaryTree& tree);

  // The children of the wide node at `node`, from left to right; a leaf is its own child.
  uint32_t Children(uint32_t node, uint32_t (&chosen)[kBvhWidth]) const;

 private:
  struct Plan {
    float cost[kBvhWidth];       // below i + 1 roots or fewer
    uint8_t of_left[kBvhWidth];  // how many of these are in the left subtree; 0: the node itself
  };
  // Added to the half areas.
  struct Least {
    float node, leaf;
  };
  void MakePlan(size_t at, const Least& least);
  void Add(uint32_t node, uint32_t roots, uint32_t (&chosen)[kBvhWidth], uint32_t& count) const;

  const BinaryTree& tree_;
  std::vector<Plan> plans_;
};

}  // namespace swell

#endif  // SWELL_BVH_COLLAPSE_H_
