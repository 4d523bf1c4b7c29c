// A collapsed binary tree in, its wide nodes out.
#ifndef SWELL_BVH_WIDENER_H_
#define SWELL_BVH_WIDENER_H_

#include <cstdint>
#include <vector>

#include "src/bvh/collapse.h"
#include "src/bvh/widen.h"

namespace swell {

BvhNode EmptyNode();
void SetBox(BvhNode& node, uint32_t i, const Bounds4& box);

// By the centres of the children's boxes along the diagonal of each octant.
void SetOrder(BvhNode& node, uint32_t count);

// Wide nodes of a binary tree, depth first.
class Widener {
 public:
  Widener(const BinaryTree& tree, const Collapse& collapse) : tree_(tree), collapse_(collapse) {}

  // Adds the nodes below `binary`, which is not a leaf. on_leaf(reference, level) returns what to
  // store for a leaf. Returns the index of the first one.
  template <class OnLeaf> uint32_t Add(uint32_t binary, const OnLeaf& on_leaf) {
    const uint32_t root = static_cast<uint32_t>(nodes.size());
    waiting_.push_back({binary, kEmptyChild, 0, 1});
    while (!waiting_.empty()) {
      const Waiting next = waiting_.back();
      waiting_.pop_back();
      const uint32_t index = static_cast<uint32_t>(nodes.size());
      if (next.parent != kEmptyChild) nodes[next.parent].child[next.slot] = index;
      BvhNode node = EmptyNode();
      uint32_t chosen[kBvhWidth];
      const uint32_t count = collapse_.Children(next.binary, chosen);
      for (uint32_t i = count; i-- > 0;) {
        const BinaryNode& child = tree_.nodes[chosen[i]];
        SetBox(node, i, child.box);
        if (!IsLeaf(child)) {
          waiting_.push_back({chosen[i], index, i, next.level + 1});
        } else {
          node.child[i] = on_leaf(child.leaf, next.level);
        }
      }
      SetOrder(node, count);
      nodes.push_back(node);
    }
    return root;
  }

  std::vector<BvhNode> nodes;

 private:
  struct Waiting {
    uint32_t binary, parent, slot, level;
  };

  const BinaryTree& tree_;
  const Collapse& collapse_;
  std::vector<Waiting> waiting_;
};

}  // namespace swell

#endif  // SWELL_BVH_WIDENER_H_
