// A binary tree in, which of its nodes become the children of wide nodes out.
#include "src/bvh/collapse.h"

#include <algorithm>
#include <limits>

namespace swell {

namespace {

bool HasInstances(const BinaryTree& tree) {
  constexpr uint32_t kInstance = kLeafBit | kSphereLeafBit | kInstanceLeafBit;
  return std::any_of(tree.nodes.begin(), tree.nodes.end(), [](const BinaryNode& node) {
    return node.left == 0 && (node.leaf & kInstance) == kInstance;
  });
}

// The mean half area of the largest subtrees that fit into one node.
float SmallSubtreeArea(const BinaryTree& tree) {
  std::vector<uint32_t> leaves(tree.nodes.size(), 1);
  double sum = 0.0;
  size_t count = 0;
  const auto add = [&](uint32_t node) {
    if (leaves[node] > kBvhWidth) return;
    sum += tree.nodes[node].box.HalfArea();
    ++count;
  };
  for (size_t i = tree.nodes.size(); i-- > 0;) {
    const BinaryNode& node = tree.nodes[i];
    if (IsLeaf(node)) continue;
    leaves[i] = leaves[node.left] + leaves[node.right];
    if (leaves[i] <= kBvhWidth) continue;
    add(node.left);
    add(node.right);
  }
  add(0);  // all of it, if it is that small
  return static_cast<float>(sum / static_cast<double>(std::max<size_t>(count, 1)));
}

}  // namespace

Collapse::Collapse(const BinaryTree& tree) : tree_(tree), plans_(tree.nodes.size()) {
  // A little for everything, so that of equal areas the fewest nodes are chosen. Instances are
  // leaves by themselves, so that nodes are most of their memory: there a node costs its memory,
  // too. So it does where primitives are cut: half as much takes a tenth of the nodes of 300k
  // pillars for 0.7 % of the cost.
  const float tiny = 1e-7f * tree.nodes[0].box.HalfArea() + 1e-30f;
  Least least = {tiny, tiny};
  if (HasInstances(tree)) least.node += SmallSubtreeArea(tree);
  if (tree.cut) least.node += 0.5f * SmallSubtreeArea(tree);
  for (size_t i = plans_.size(); i-- > 0;) MakePlan(i, least);
}

uint32_t Collapse::Children(uint32_t node, uint32_t (&chosen)[kBvhWidth]) const {
  uint32_t count = 0;
  Add(node, kBvhWidth, chosen, count);
  return count;
}

void Collapse::MakePlan(size_t at, const Least& least) {
  const BinaryNode& node = tree_.nodes[at];
  Plan& plan = plans_[at];
  const float own = node.box.HalfArea() + (IsLeaf(node) ? least.leaf : least.node);
  plan.of_left[0] = 0;
  if (node.left == 0) {
    for (uint32_t i = 0; i < kBvhWidth; ++i) plan.cost[i] = own;
    for (uint32_t i = 0; i < kBvhWidth; ++i) plan.of_left[i] = 0;
    return;
  }
  const Plan& left = plans_[node.left];
  const Plan& right = plans_[node.right];
  for (uint32_t i = 1; i < kBvhWidth; ++i) {
    float best = std::numeric_limits<float>::infinity();
    uint32_t of_left = 1;
    for (uint32_t k = 0; k < i; ++k) {
      const float cost = left.cost[k] + right.cost[i - 1 - k];
      of_left = cost < best ? k + 1 : of_left;
      best = std::min(cost, best);
    }
    plan.cost[i] = best;
    plan.of_left[i] = static_cast<uint8_t>(of_left);
  }
  plan.cost[0] = IsLeaf(node) ? own : own + plan.cost[kBvhWidth - 1];
  for (uint32_t i = 1; i + 1 < kBvhWidth; ++i) {
    if (plan.cost[0] >= plan.cost[i]) continue;
    plan.cost[i] = plan.cost[0];
    plan.of_left[i] = 0;
  }
}

void Collapse::Add(uint32_t node, uint32_t roots, uint32_t (&chosen)[kBvhWidth],
                   uint32_t& count) const {
  const uint32_t of_left = plans_[node].of_left[roots - 1];
  if (of_left == 0) {
    chosen[count++] = node;
    return;
  }
  Add(tree_.nodes[node].left, of_left, chosen, count);
  Add(tree_.nodes[node].right, roots - of_left, chosen, count);
}

}  // namespace swell
