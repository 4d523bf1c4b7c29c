// A binary tree in; which of its nodes become the children of each wide node out.
#include "src/bvh/collapse.h"

#include <tbb/parallel_invoke.h>

namespace swell {
namespace {

constexpr uint32_t kParallel = 4096;  // primitives below which one thread does a subtree

uint32_t ShiftOf(uint32_t places) { return 4 * (places - 1); }

}  // namespace

Collapse::Collapse(const BinaryTree& tree) : tree_(tree), left_places_(tree.nodes.size()) {
  const Areas small = SmallSubtrees(0);
  per_node_ = static_cast<float>(small.sum / static_cast<double>(small.count));
  Solve(0);
}

Collapse::Areas Collapse::SmallSubtrees(uint32_t at) const {
  const BinaryNode& node = tree_.nodes[at];
  if (node.count <= kBvhWidth || node.right == 0) return {node.box.HalfArea(), 1};
  const Areas left = SmallSubtrees(at + 1), right = SmallSubtrees(node.right);
  return {left.sum + right.sum, left.count + right.count};
}

Collapse::Costs Collapse::Solve(uint32_t at) {
  const BinaryNode& node = tree_.nodes[at];
  Costs costs{};
  if (node.right == 0) return costs;
  Costs left, right;
  const auto solve_left = [&] { left = Solve(at + 1); };
  const auto solve_right = [&] { right = Solve(node.right); };
  if (node.count >= kParallel) {
    tbb::parallel_invoke(solve_left, solve_right);
  } else {
    solve_left();
    solve_right();
  }
  uint32_t choices = 0;
  for (uint32_t places = 2; places <= kBvhWidth; ++places) {
    float& least = costs.of[places - 1];
    uint32_t best = 1;
    least = left.of[0] + right.of[places - 2];
    for (uint32_t l = 2; l < places; ++l) {
      const float cost = left.of[l - 1] + right.of[places - l - 1];
      if (cost < least) {
        least = cost;
        best = l;
      }
    }
    choices |= best << ShiftOf(places);
  }
  costs.of[0] = costs.of[kBvhWidth - 1] + node.box.HalfArea() + per_node_;
  for (uint32_t places = 2; places < kBvhWidth; ++places) {
    if (costs.of[places - 1] < costs.of[0]) continue;
    costs.of[places - 1] = costs.of[0];
    choices &= ~(15u << ShiftOf(places));
  }
  left_places_[at] = choices;
  return costs;
}

void Collapse::Take(uint32_t at, uint32_t places, uint32_t (&chosen)[kBvhWidth],
                    uint32_t& count) const {
  const uint32_t left = places == 1 ? 0 : left_places_[at] >> ShiftOf(places) & 15u;
  if (left == 0) {
    chosen[count++] = at;
    return;
  }
  Take(at + 1, left, chosen, count);
  Take(tree_.nodes[at].right, places - left, chosen, count);
}

uint32_t Collapse::Children(uint32_t at, uint32_t (&chosen)[kBvhWidth]) const {
  uint32_t count = 0;
  Take(at, kBvhWidth, chosen, count);
  return count;
}

}  // namespace swell
