// Nodes and blocks of a tree in, the order of their children for rays that any hit ends out.
#ifndef SWELL_BVH_ORDER_SLOTS_H_
#define SWELL_BVH_ORDER_SLOTS_H_

#include <cstdint>
#include <vector>

#include "src/bvh/bvh.h"

namespace swell {

// Rays that any hit ends visit the children of a node from the last slot to the first, so the last
// one is to be where a hit is likeliest for what the visit costs. (Nah and Manocha 2014, "SATO:
// Surface Area Traversal Order for Shadow Ray Tracing", have such an order by surface areas.) The
// children's order for closest hits stays what it is.
//
// This pays where primitives overlap so much that they were cut: rays among 300k pillars that end
// at a hit visit 29 to 34 % fewer nodes and blocks. Where they do not overlap all children stop
// about as many rays, and what is near comes first as often as not: up to 16 % more visits.
class SlotOrder {
 public:
  explicit SlotOrder(Bvh& bvh) : bvh_(bvh), of_node_(bvh.nodes.size()) {}

  // Estimates nodes [first, first + count), whose children come after them and were estimated
  // before unless they are among them; sort: and sorts their children.
  void Add(uint32_t first, uint32_t count, bool sort);

 private:
  // Of a ray that enters a subtree: how likely it is stopped, and how many nodes and blocks it
  // visits if it is not.
  struct Subtree {
    float chance, cost;
  };
  Subtree OfLeaf(uint32_t child, float half_area) const;

  Bvh& bvh_;
  std::vector<Subtree> of_node_;
};

}  // namespace swell

#endif  // SWELL_BVH_ORDER_SLOTS_H_
