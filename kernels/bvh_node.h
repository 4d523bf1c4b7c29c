// The layout of the wide BVH as the traversal kernels see it.
#ifndef SWELL_KERNELS_BVH_NODE_H_
#define SWELL_KERNELS_BVH_NODE_H_

#include <cstdint>

#include "kernels/scene_view.h"

namespace swell {

inline constexpr uint32_t kBvhWidth = 8;      // children of a node
inline constexpr uint32_t kBlockWidth = 8;    // triangles of a leaf block
inline constexpr uint32_t kMaxBvhDepth = 64;  // levels of wide nodes; proven by the builder

// Entries of a traversal's stack: at most 7 siblings wait on every level above the current node,
// in the tree of the world and in that of an object.
inline constexpr uint32_t kMaxBvhStack = 2 * kMaxBvhDepth * (kBvhWidth - 1) + 1;

// Child references: an inner node's index, or a leaf: one sphere or instance (its row in the low 29
// bits), or the first triangles of a block (its index in the low 27 bits, how many less one in the
// three bits above); leaves may share a block. Empty children come last and have inverted boxes.
inline constexpr uint32_t kLeafBit = 0x80000000u;
inline constexpr uint32_t kSphereLeafBit = 0x40000000u;    // a sphere or an instance
inline constexpr uint32_t kInstanceLeafBit = 0x20000000u;  // beside kSphereLeafBit: an instance
inline constexpr uint32_t kSphereIndexMask = 0x1FFFFFFFu;
inline constexpr uint32_t kBlockCountShift = 27;
inline constexpr uint32_t kBlockIndexMask = (1u << kBlockCountShift) - 1;
inline constexpr uint32_t kEmptyChild = 0xFFFFFFFFu;

inline constexpr uint32_t LeafBlock(uint32_t child) { return child & kBlockIndexMask; }
inline constexpr uint32_t LeafCount(uint32_t child) {
  return ((child >> kBlockCountShift) & 7) + 1;
}

// Boxes of all children in columns: bounds[0..2] lower x, y, z, [3..5] upper. order[octant] lists
// every slot once, in kOrderBits each from the lowest bit on: those of the children, the farthest
// first for rays of that octant, then the empty ones; the bits above hold the number of children.
// Bit k of an octant says that the ray's direction is negative in axis k.
struct alignas(64) BvhNode {
  float bounds[6][kBvhWidth];
  uint32_t child[kBvhWidth];
  uint32_t order[8];
};
static_assert(sizeof(BvhNode) == 256, "four cache lines");

inline constexpr uint32_t kOrderBits = 3;
inline constexpr uint32_t kChildCountShift = kOrderBits * kBvhWidth;

inline uint32_t ChildCount(const BvhNode& node) { return node.order[0] >> kChildCountShift; }

// Triangles of one or more leaves in columns: vertex[i][axis][triangle]. Rows that are left are
// points, which no ray hits, with prim kNoPrim.
struct alignas(64) TriangleBlock {
  float vertex[3][3][kBlockWidth];
  uint32_t prim[kBlockWidth];
};
static_assert(sizeof(TriangleBlock) == 320, "five cache lines");

// A primitive's box is widened on every side by its largest absolute coordinate times this, and a
// ray widens all boxes by the largest absolute coordinate of its origin times this; see
// kernels/triangle-inl.h for what the two margins cover.
inline constexpr float kBoxMargin = 0x1p-19f;

// What its instances share: where its tree begins, and a box that holds it.
struct ObjectRecord {
  float middle[3], half[3];
  uint32_t root;  // node
  uint32_t unused;
};

// The trees. The root of the world's is node 0, which is always there; its leaves may be instances,
// the other trees' may not. Object spaces are as wide as their objects' files made them.
struct BvhView {
  const BvhNode* nodes;
  const TriangleBlock* blocks;
  const SphereRecord* spheres;
  const float* sphere_boxes;  // six floats per sphere: lower x, y, z, upper x, y, z; widened
  const InstanceRecord* instances;
  const ObjectRecord* objects;
  uint32_t node_count;
  uint32_t block_count;
  uint32_t sphere_count;
  uint32_t triangle_count;  // sphere i is primitive triangle_count + i
  uint32_t depth;           // levels of nodes of the deepest tree, at most kMaxBvhDepth
  float max_abs_coord;      // of any box of any tree
};

// How rays go through the tree. The hits are the same.
enum class Traversal : uint32_t {
  kAuto,    // bundles while they are full enough, then single rays
  kPacket,  // bundles to the end, tested by packets of as many rays as there are lanes
  kSingle,  // a ray against all children of a node
};

// What kAuto chooses from, for tests and benchmarks.
struct NamedTraversal {
  const char* name;
  Traversal traversal;
};
inline constexpr NamedTraversal kFixedTraversals[] = {
    {"packet", Traversal::kPacket},
    {"single", Traversal::kSingle},
};

}  // namespace swell

#endif  // SWELL_KERNELS_BVH_NODE_H_
