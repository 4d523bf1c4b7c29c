// Binary trees in, wide nodes and leaf blocks out.
#include "src/bvh/widen.h"

#include <malloc.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "kernels/records.h"
#include "src/base/check.h"
#include "src/bvh/build_sah.h"
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

void SetBox(BvhNode& node, uint32_t i, const Bounds4& box) {
  for (int k = 0; k < 3; ++k) {
    node.bounds[k][i] = box.lower[k];
    node.bounds[k + 3][i] = box.upper[k];
  }
}

// By the centres of the children's boxes along the diagonal of each octant.
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
        if (child.left != 0) {
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

TriangleBlock MakeBlock(const uint32_t* prims, uint32_t count, const Scene& scene) {
  TriangleBlock block{};
  for (uint32_t i = 0; i < kBlockWidth; ++i) {
    block.prim[i] = kNoPrim;
    if (i >= count) continue;
    block.prim[i] = prims[i];
    if (!CanBeHit(scene, block.prim[i])) continue;
    for (int k = 0; k < 3; ++k) {
      const float* p = &scene.positions[3 * size_t{scene.indices[3 * size_t{block.prim[i]} + k]}];
      for (int axis = 0; axis < 3; ++axis) block.vertex[k][axis][i] = p[axis];
    }
  }
  return block;
}

constexpr size_t kBlocksToTrim = size_t{1} << 16;  // of 320 bytes: where memory matters

// Where a part's nodes and blocks begin in the whole tree.
struct Place {
  std::unique_ptr<TreePart> part;
  uint32_t first_node, first_block;

  uint32_t Move(uint32_t child) const { return MoveChild(child, first_node, first_block); }
};

// The upper levels as a binary tree whose leaves are rows of `ends`; takes the nodes apart.
struct Upper {
  struct End {
    size_t place;
    uint32_t root, depth;
  };
  BinaryTree tree;
  std::vector<Place> places;
  std::vector<End> ends;

  uint32_t Add(UpperNode& node) {
    if (node.part != nullptr) places.push_back({std::move(node.part), 0, 0});
    const uint32_t at = static_cast<uint32_t>(tree.nodes.size());
    tree.nodes.push_back({node.box, 0, 0, 0});
    if (node.left == nullptr) {
      tree.nodes[at].leaf = static_cast<uint32_t>(ends.size());
      ends.push_back({places.size() - 1, node.root, node.depth});
      return at;
    }
    const uint32_t left = Add(*node.left);
    node.left.reset();
    const uint32_t right = Add(*node.right);
    node.right.reset();
    tree.nodes[at].left = left;
    tree.nodes[at].right = right;
    return at;
  }
};

// Copies a part to its place and frees it.
void PutPart(const Place& place, const Scene& scene, Bvh& bvh) {
  TreePart& part = *place.part;
  for (size_t i = 0; i < part.nodes.size(); ++i) {
    BvhNode& node = bvh.nodes[place.first_node + i];
    node = part.nodes[i];
    for (uint32_t k = 0; k < ChildCount(node); ++k) node.child[k] = place.Move(node.child[k]);
  }
  part.nodes = {};
  for (size_t i = 0; i < part.block_begins.size(); ++i) {
    const size_t begin = part.block_begins[i];
    const size_t end =
        i + 1 < part.block_begins.size() ? part.block_begins[i + 1] : part.prims.size();
    bvh.blocks[place.first_block + i] =
        MakeBlock(&part.prims[begin], static_cast<uint32_t>(end - begin), scene);
  }
  part.prims = {};
  part.block_begins = {};
}

template <class T> PageArray<T> Copy(const std::vector<T>& from) {
  PageArray<T> to(from.size());
  std::copy(from.begin(), from.end(), to.data());
  return to;
}

}  // namespace

void Widen(const BinaryTree& tree, UpperNode& top) {
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
  const auto add_top = [&](const auto& self, uint32_t binary, UpperNode& node) -> void {
    const BinaryNode& from = tree.nodes[binary];
    node.box = from.box;
    if (!is_end[binary]) {
      node.left = std::make_unique<UpperNode>();
      node.right = std::make_unique<UpperNode>();
      self(self, from.left, *node.left);
      self(self, from.right, *node.right);
    } else if (from.left == 0) {
      node.root = from.leaf;
    } else {
      node.root = widener.Add(binary, [&](uint32_t leaf, uint32_t level) {
        node.depth = std::max(node.depth, level);
        return leaf;
      });
    }
  };
  add_top(add_top, 0, top);
  top.part = std::make_unique<TreePart>(
      TreePart{Copy(widener.nodes), Copy(tree.prims), Copy(tree.block_begins), 0});
}

void MakeEmpty(Bvh& bvh) {
  bvh.nodes = PageArray<BvhNode>(1);
  bvh.nodes[0] = EmptyNode();
  SetOrder(bvh.nodes[0], 0);
  bvh.depth = 1;
}

namespace {

// Makes the upper nodes, and room for the parts; tells their places.
std::vector<Place> MakeUpperNodes(UpperNode& root, Bvh& bvh) {
  Upper upper;
  upper.Add(root);
  std::vector<Place>& places = upper.places;
  const Collapse collapse(upper.tree);
  Widener widener(upper.tree, collapse);
  widener.Add(0, [&](uint32_t leaf, uint32_t level) {
    bvh.depth = std::max(bvh.depth, level + upper.ends[leaf].depth);
    return kLeafBit | leaf;
  });
  const std::vector<BvhNode>& upper_nodes = widener.nodes;
  SWELL_CHECK(bvh.depth <= kMaxBvhDepth);
  size_t nodes = upper_nodes.size(), blocks = 0;
  for (Place& place : places) {
    place.first_node = static_cast<uint32_t>(nodes);
    place.first_block = static_cast<uint32_t>(blocks);
    nodes += place.part->nodes.size();
    blocks += place.part->block_begins.size();
  }
  SWELL_CHECK(blocks <= kBlockIndexMask);
  bvh.nodes = PageArray<BvhNode>(nodes);
  bvh.blocks = PageArray<TriangleBlock>(blocks);
  for (size_t i = 0; i < upper_nodes.size(); ++i) {
    bvh.nodes[i] = upper_nodes[i];
    for (uint32_t k = 0; k < ChildCount(upper_nodes[i]); ++k) {
      const uint32_t child = upper_nodes[i].child[k];
      if ((child & kLeafBit) == 0) continue;
      const Upper::End& end = upper.ends[child & ~kLeafBit];
      bvh.nodes[i].child[k] = places[end.place].Move(end.root);
    }
  }
  return std::move(upper.places);
}

}  // namespace

void Assemble(UpperNode& root, const Scene& scene, BuildProgress* progress, Bvh& bvh) {
  std::vector<Place> places = MakeUpperNodes(root, bvh);
  // What the upper levels took, in small pieces, is a tenth of the tree that is written now.
  if (bvh.blocks.size() >= kBlocksToTrim) malloc_trim(0);
  tbb::parallel_for(size_t{0}, places.size(), [&](size_t i) {
    PutPart(places[i], scene, bvh);
    if (progress != nullptr) progress->done += places[i].part->share;
  });
  for (int k = 0; k < 3; ++k) {
    bvh.max_abs_coord =
        std::max({bvh.max_abs_coord, std::fabs(root.box.lower[k]), std::fabs(root.box.upper[k])});
  }
}

}  // namespace swell
