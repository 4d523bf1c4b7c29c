// Parts of a tree in, the whole tree out.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "kernels/records.h"
#include "src/base/check.h"
#include "src/bvh/bounds4.h"
#include "src/bvh/build_sah.h"
#include "src/bvh/collapse.h"
#include "src/bvh/order_slots.h"
#include "src/bvh/widen.h"
#include "src/bvh/widener.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace swell {
namespace {

constexpr size_t kManyParts = 64;

TriangleBlock MakeBlock(const uint32_t* prims, uint32_t count, const Scene& scene) {
  TriangleBlock block{};
  for (uint32_t i = 0; i < kBlockWidth; ++i) {
    block.prim[i] = kNoPrim;
    if (i >= count) continue;
    block.prim[i] = prims[i];
    if (!CanBeHit(scene, block.prim[i])) continue;
    for (int k = 0; k < 3; ++k) {
      const Float4 p = VertexOf(scene, block.prim[i], static_cast<size_t>(k));
      for (int axis = 0; axis < 3; ++axis) block.vertex[k][axis][i] = p[axis];
    }
  }
  return block;
}

// Where a part's nodes and blocks begin in the whole tree.
struct Place {
  std::unique_ptr<TreePart> part;
  uint32_t first_node, first_block;

  uint32_t Move(uint32_t child) const { return MoveChild(child, first_node, first_block); }
};

// The upper levels as a binary tree whose leaves are rows of `ends`.
struct Upper {
  struct End {
    uint32_t place, root, depth;
  };
  BinaryTree tree;
  std::vector<Place> places;
  std::vector<End> ends;

  // Takes the parts out of the nodes.
  uint32_t Add(UpperNode& node) {
    const uint32_t at = static_cast<uint32_t>(tree.nodes.size());
    if (node.part != nullptr) {
      AddTop(std::exchange(node.part->top, {}), at);
      places.push_back({std::move(node.part), 0, 0});
      return at;
    }
    tree.nodes.push_back({node.box, 0, 0, 0, 0});
    const uint32_t left = Add(*node.left);
    const uint32_t right = Add(*node.right);
    tree.nodes[at].left = left;
    tree.nodes[at].right = right;
    return at;
  }

 private:
  void AddTop(const PageArray<BinaryNode>& top, uint32_t first) {
    for (size_t i = 0; i < top.size(); ++i) {
      BinaryNode node = top[i];
      const bool is_leaf = IsLeaf(node);
      if (node.left != 0) {
        node.left += first;
        node.right += first;
      }
      if (is_leaf) {
        ends.push_back({static_cast<uint32_t>(places.size()), node.leaf, node.depth});
        node.leaf = kLeafBit | static_cast<uint32_t>(ends.size() - 1);
      }
      tree.nodes.push_back(node);
    }
  }
};

// What the whole tree is made of: parts, and the wide nodes above them, whose leaves are rows of
// `ends`.
struct Pieces {
  std::vector<Place> places;
  std::vector<Upper::End> ends;
  std::vector<BvhNode> nodes;
  uint32_t depth = 0;
};

size_t CountNodes(const UpperNode& node) {
  if (node.part != nullptr) return node.part->top.size();
  return 1 + CountNodes(*node.left) + CountNodes(*node.right);
}

Pieces TakeApart(std::unique_ptr<UpperNode> root) {
  Upper upper;
  upper.tree.nodes.reserve(CountNodes(*root));
  upper.Add(*root);
  root.reset();
  Pieces pieces = {std::move(upper.places), std::move(upper.ends), {}, 0};
  const Collapse collapse(upper.tree);
  Widener widener(upper.tree, collapse);
  widener.Add(0, [&](uint32_t leaf, uint32_t level) {
    pieces.depth = std::max(pieces.depth, level + pieces.ends[leaf & ~kLeafBit].depth);
    return leaf;
  });
  pieces.nodes = std::move(widener.nodes);
  return pieces;
}

// Copies a part to its place and frees it. `slots`: if children are sorted.
void PutPart(Place& place, const Scene& scene, Bvh& bvh, std::optional<SlotOrder>& slots) {
  TreePart& part = *place.part;
  for (size_t i = 0; i < part.nodes.size(); ++i) {
    BvhNode& node = bvh.nodes[place.first_node + i];
    node = part.nodes[i];
    for (uint32_t k = 0; k < ChildCount(node); ++k) node.child[k] = place.Move(node.child[k]);
  }
  const uint32_t nodes = static_cast<uint32_t>(part.nodes.size());
  part.nodes = {};
  const uint32_t* rows = part.rows.data();
  for (uint32_t i = 0; i < part.blocks; ++i) {
    bvh.blocks[place.first_block + i] = MakeBlock(rows + rows[i], rows[i + 1] - rows[i], scene);
  }
  part.rows = {};
  if (slots) slots->Add(place.first_node, nodes, part.cut);
}

}  // namespace

void Assemble(std::unique_ptr<UpperNode> root, const Scene& scene, BuildProgress* progress,
              Bvh& bvh) {
  for (int k = 0; k < 3; ++k) {
    bvh.max_abs_coord =
        std::max({bvh.max_abs_coord, std::fabs(root->box.lower[k]), std::fabs(root->box.upper[k])});
  }
  Pieces pieces = TakeApart(std::move(root));
  // What the parts' tops took: the C library would keep it until after the peak.
#ifdef __GLIBC__
  if (pieces.places.size() > kManyParts) malloc_trim(0);
#endif
  std::vector<Place>& places = pieces.places;
  bvh.depth = pieces.depth;
  SWELL_CHECK(bvh.depth <= kMaxBvhDepth);
  size_t nodes = pieces.nodes.size(), blocks = 0;
  for (Place& place : places) {
    place.first_node = static_cast<uint32_t>(nodes);
    place.first_block = static_cast<uint32_t>(blocks);
    nodes += place.part->nodes.size();
    blocks += place.part->blocks;
  }
  SWELL_CHECK(blocks <= kBlockIndexMask);
  bvh.nodes = PageArray<BvhNode>(nodes);
  bvh.blocks = PageArray<TriangleBlock>(blocks);
  for (size_t i = 0; i < pieces.nodes.size(); ++i) {
    BvhNode& node = bvh.nodes[i];
    node = pieces.nodes[i];
    for (uint32_t k = 0; k < ChildCount(node); ++k) {
      if ((node.child[k] & kLeafBit) == 0) continue;
      const Upper::End& end = pieces.ends[node.child[k] & ~kLeafBit];
      node.child[k] = places[end.place].Move(end.root);
    }
  }
  std::optional<SlotOrder> slots;
  const auto is_cut = [](const Place& place) { return place.part->cut; };
  if (std::any_of(places.begin(), places.end(), is_cut)) slots.emplace(bvh);
  tbb::parallel_for(size_t{0}, places.size(), [&](size_t i) {
    PutPart(places[i], scene, bvh, slots);
    if (progress != nullptr) progress->done += places[i].part->share;
  });
  if (slots) slots->Add(0, static_cast<uint32_t>(pieces.nodes.size()), true);
}

}  // namespace swell
