// Binary trees in, wide nodes and leaf blocks out.
#include "src/bvh/widen.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "src/bvh/collapse.h"
#include "src/bvh/share_blocks.h"
#include "src/bvh/widener.h"

namespace swell {
namespace {

template <class T> PageArray<T> Copy(const std::vector<T>& from) {
  PageArray<T> to(from.size());
  std::copy(from.begin(), from.end(), to.data());
  return to;
}

// A block for every leaf.
PageArray<uint32_t> OwnRows(const BinaryTree& tree) {
  const uint32_t blocks = static_cast<uint32_t>(tree.block_begins.size());
  PageArray<uint32_t> rows(blocks + 1 + tree.prims.size());
  for (uint32_t i = 0; i < blocks; ++i) rows[i] = blocks + 1 + tree.block_begins[i];
  rows[blocks] = static_cast<uint32_t>(rows.size());
  std::copy(tree.prims.begin(), tree.prims.end(), rows.data() + blocks + 1);
  return rows;
}

}  // namespace

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

void SetBox(BvhNode& node, uint32_t i, const Bounds4& box) {
  for (int k = 0; k < 3; ++k) {
    node.bounds[k][i] = box.lower[k];
    node.bounds[k + 3][i] = box.upper[k];
  }
}

void SetOrder(BvhNode& node, uint32_t count) {
  float centre[3][kBvhWidth];
  for (int k = 0; k < 3; ++k) {
    for (uint32_t i = 0; i < count; ++i) {
      centre[k][i] = node.bounds[k][i] + node.bounds[k + 3][i];
      if (!std::isfinite(centre[k][i])) centre[k][i] = 0.0f;
    }
  }
  for (uint32_t octant = 0; octant < 4; ++octant) {
    float along[kBvhWidth];
    uint32_t slots[kBvhWidth];
    for (uint32_t i = 0; i < count; ++i) {
      const float x = (octant & 1) != 0 ? -centre[0][i] : centre[0][i];
      const float y = (octant & 2) != 0 ? -centre[1][i] : centre[1][i];
      const float at = x + y + centre[2][i];
      uint32_t place = i;
      for (; place > 0 && along[place - 1] < at; --place) {
        along[place] = along[place - 1];
        slots[place] = slots[place - 1];
      }
      along[place] = at;
      slots[place] = i;
    }
    // The opposite octant sees the children the other way round. Empty slots come last: kernels
    // look up all eight, and a child that stood there again would be visited again.
    uint32_t order = count << kChildCountShift, opposite = order;
    for (uint32_t i = 0; i < kBvhWidth; ++i) {
      order |= (i < count ? slots[i] : i) << (kOrderBits * i);
      opposite |= (i < count ? slots[count - 1 - i] : i) << (kOrderBits * i);
    }
    node.order[octant] = order;
    node.order[7 - octant] = opposite;
  }
}

TreePart Widen(const BinaryTree& tree) {
  const Collapse collapse(tree);
  // What would be the children of the root's children: deep enough that what is lost there by
  // choosing children apart is little (a valley of 1M triangles: 0.2 % instead of 1.5 % by stopping
  // at the root).
  std::vector<bool> is_end(tree.nodes.size());
  uint32_t children[kBvhWidth], grandchildren[kBvhWidth];
  for (uint32_t i = collapse.Children(0, children); i-- > 0;) {
    for (uint32_t k = collapse.Children(children[i], grandchildren); k-- > 0;) {
      is_end[grandchildren[k]] = true;
    }
  }
  Widener widener(tree, collapse);
  std::vector<BinaryNode> top;
  const auto add_top = [&](const auto& self, uint32_t binary) -> uint32_t {
    const BinaryNode& from = tree.nodes[binary];
    const uint32_t at = static_cast<uint32_t>(top.size());
    top.push_back({from.box, 0, 0, from.leaf, 0});
    if (!is_end[binary]) {
      const uint32_t left = self(self, from.left);
      const uint32_t right = self(self, from.right);
      top[at].left = left;
      top[at].right = right;
    } else if (!IsLeaf(from)) {
      uint32_t depth = 0;
      top[at].leaf = widener.Add(binary, [&](uint32_t leaf, uint32_t level) {
        depth = std::max(depth, level);
        return leaf;
      });
      top[at].depth = depth;
    }
    return at;
  };
  add_top(add_top, 0);
  const uint32_t blocks = static_cast<uint32_t>(tree.block_begins.size());
  if (!tree.cut) return {Copy(top), Copy(widener.nodes), OwnRows(tree), blocks, false, 0};
  BlockSharer sharer(tree);
  for (BinaryNode& node : top) sharer.Place(node.leaf);
  for (BvhNode& node : widener.nodes) sharer.Place(node);
  return {Copy(top), Copy(widener.nodes), sharer.Rows(), sharer.blocks(), true, 0};
}

void MakeEmpty(Bvh& bvh) {
  bvh.nodes = PageArray<BvhNode>(1);
  bvh.nodes[0] = EmptyNode();
  SetOrder(bvh.nodes[0], 0);
  bvh.depth = 1;
}

}  // namespace swell
