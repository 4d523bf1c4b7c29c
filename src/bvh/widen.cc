// A binary tree in, wide nodes and leaf blocks out.
#include "src/bvh/widen.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include "kernels/records.h"
#include "src/base/check.h"
#include "src/bvh/collapse.h"

namespace swell {
namespace {

BvhNode EmptyNode() {
  BvhNode node{};
  for (uint32_t i = 0; i < kBvhWidth; ++i) {
    for (int k = 0; k < 3; ++k) {
      node.bounds[k][i] = std::numeric_limits<float>::infinity();
      node.bounds[k + 3][i] = -std::numeric_limits<float>::infinity();
    }
    node.child[i] = kEmptyChild;
  }
  return node;
}

void SetBox(BvhNode& node, uint32_t i, const Box3& box) {
  for (int k = 0; k < 3; ++k) {
    node.bounds[k][i] = box.lower[k];
    node.bounds[k + 3][i] = box.upper[k];
  }
}

// By the centres of the children's boxes along the diagonal of each octant.
void SetOrder(BvhNode& node, uint32_t count) {
  for (uint32_t octant = 0; octant < 8; ++octant) {
    float along[kBvhWidth] = {};
    uint32_t slots[kBvhWidth];
    for (uint32_t i = 0; i < kBvhWidth; ++i) slots[i] = i;
    for (uint32_t i = 0; i < count; ++i) {
      for (int k = 0; k < 3; ++k) {
        const float twice_centre = node.bounds[k][i] + node.bounds[k + 3][i];
        along[i] += ((octant >> k) & 1) != 0 ? -twice_centre : twice_centre;
      }
      if (!std::isfinite(along[i])) along[i] = 0.0f;
    }
    std::stable_sort(slots, slots + count,
                     [&](uint32_t a, uint32_t b) { return along[a] > along[b]; });
    uint32_t order = count << kChildCountShift;
    for (uint32_t i = 0; i < kBvhWidth; ++i) order |= slots[i] << (kOrderBits * i);
    node.order[octant] = order;
  }
}

// Opens inner nodes below `at`, the largest first, until there are kBvhWidth or only leaves.
uint32_t ChooseChildren(const BinaryTree& tree, uint32_t at, uint32_t (&chosen)[kBvhWidth]) {
  chosen[0] = at;
  uint32_t count = 1;
  while (count < kBvhWidth) {
    uint32_t open = kBvhWidth;
    float largest = -1.0f;
    uint32_t most = 0;  // of equal areas, the one with most primitives
    for (uint32_t i = 0; i < count; ++i) {
      const BinaryNode& node = tree.nodes[chosen[i]];
      const float area = node.box.HalfArea();
      if (node.right == 0 || area < largest || (area == largest && node.count <= most)) continue;
      largest = area;
      most = node.count;
      open = i;
    }
    if (open == kBvhWidth) break;
    const uint32_t opened = chosen[open];
    chosen[open] = opened + 1;
    chosen[count++] = tree.nodes[opened].right;
  }
  return count;
}

// The shape of the wide tree, depth first; leaf blocks are only numbered.
class Widener {
 public:
  Widener(const BinaryTree& tree, const Bvh& bvh)
      : tree_(tree),
        first_sphere_(bvh.triangle_count),
        first_instance_(bvh.triangle_count + bvh.sphere_count) {
    const BuildPrim* prims = tree.prims.data();
    if (std::any_of(prims, prims + tree.prims.size(),
                    [&](const BuildPrim& prim) { return prim.prim >= first_instance_; })) {
      collapse_.emplace(tree);
    }
  }

  void Run() {
    waiting_.push_back({0, kEmptyChild, 0, 1});
    while (!waiting_.empty()) {
      const Waiting next = waiting_.back();
      waiting_.pop_back();
      Add(next);
    }
  }

  std::vector<BvhNode> nodes;
  std::vector<uint32_t> leaves;  // binary leaf of every block
  uint32_t depth = 0;

 private:
  struct Waiting {
    uint32_t binary, parent, slot, level;
  };

  void Add(const Waiting& next) {
    const uint32_t index = static_cast<uint32_t>(nodes.size());
    if (next.parent != kEmptyChild) nodes[next.parent].child[next.slot] = index;
    depth = std::max(depth, next.level);
    BvhNode node = EmptyNode();
    uint32_t chosen[kBvhWidth];
    const uint32_t count = collapse_ ? collapse_->Children(next.binary, chosen)
                                     : ChooseChildren(tree_, next.binary, chosen);
    for (uint32_t i = count; i-- > 0;) {
      const BinaryNode& child = tree_.nodes[chosen[i]];
      SetBox(node, i, child.box);
      if (child.right != 0) {
        waiting_.push_back({chosen[i], index, i, next.level + 1});
      } else {
        node.child[i] = LeafReference(chosen[i]);
      }
    }
    SetOrder(node, count);
    nodes.push_back(node);
  }

  uint32_t LeafReference(uint32_t leaf) {
    const BinaryNode& node = tree_.nodes[leaf];
    const BuildPrim& first = tree_.prims[node.first];
    if (first.prim >= first_instance_) {
      return kLeafBit | kSphereLeafBit | kInstanceLeafBit | (first.prim - first_instance_);
    }
    if (first.is_sphere != 0) return kLeafBit | kSphereLeafBit | (first.prim - first_sphere_);
    const uint32_t block = static_cast<uint32_t>(leaves.size());
    leaves.push_back(leaf);
    return kLeafBit | ((node.count - 1) << kBlockCountShift) | block;
  }

  const BinaryTree& tree_;
  const uint32_t first_sphere_, first_instance_;
  std::optional<Collapse> collapse_;  // where there are instances
  std::vector<Waiting> waiting_;
};

TriangleBlock MakeBlock(const BinaryTree& tree, const BinaryNode& leaf, const Scene& scene) {
  TriangleBlock block{};
  for (uint32_t i = 0; i < kBlockWidth; ++i) {
    block.prim[i] = kNoPrim;
    if (i >= leaf.count) continue;
    block.prim[i] = tree.prims[leaf.first + i].prim;
    if (!CanBeHit(scene, block.prim[i])) continue;
    for (int k = 0; k < 3; ++k) {
      const float* p = &scene.positions[3 * size_t{scene.indices[3 * size_t{block.prim[i]} + k]}];
      for (int axis = 0; axis < 3; ++axis) block.vertex[k][axis][i] = p[axis];
    }
  }
  return block;
}

}  // namespace

void MakeEmpty(Bvh& bvh) {
  bvh.nodes = PageArray<BvhNode>(1);
  bvh.nodes[0] = EmptyNode();
  SetOrder(bvh.nodes[0], 0);
  bvh.depth = 1;
}

void Widen(const BinaryTree& tree, const Scene& scene, Bvh& bvh) {
  Widener widener(tree, bvh);
  widener.Run();
  SWELL_CHECK(widener.depth <= kMaxBvhDepth);
  bvh.depth = widener.depth;
  bvh.nodes = PageArray<BvhNode>(widener.nodes.size());
  std::copy(widener.nodes.begin(), widener.nodes.end(), bvh.nodes.data());
  bvh.blocks = PageArray<TriangleBlock>(widener.leaves.size());
  tbb::parallel_for(size_t{0}, widener.leaves.size(), [&](size_t i) {
    bvh.blocks[i] = MakeBlock(tree, tree.nodes[widener.leaves[i]], scene);
  });
  for (int k = 0; k < 3; ++k) {
    bvh.max_abs_coord = std::max({bvh.max_abs_coord, std::fabs(tree.nodes[0].box.lower[k]),
                                  std::fabs(tree.nodes[0].box.upper[k])});
  }
}

}  // namespace swell
