// The layout of the wide BVH as the traversal kernels see it.
#ifndef SWELL_KERNELS_BVH_NODE_H_
#define SWELL_KERNELS_BVH_NODE_H_

#include <cstdint>

namespace swell {

inline constexpr uint32_t kBvhWidth = 8;      // children of a node
inline constexpr uint32_t kBlockWidth = 8;    // triangles of a leaf block
inline constexpr uint32_t kMaxBvhDepth = 64;  // levels of wide nodes; proven by the builder

// Child references: an inner node's index, or a leaf. Empty children have inverted boxes.
inline constexpr uint32_t kLeafBit = 0x80000000u;
inline constexpr uint32_t kSphereLeafBit =
    0x40000000u;  // the leaf is one sphere, else blocks of triangles
inline constexpr uint32_t kEmptyChild = 0xFFFFFFFFu;

// Boxes of all children in columns: bounds[0..2] lower x, y, z, [3..5] upper.
struct alignas(64) BvhNode {
  float bounds[6][kBvhWidth];
  uint32_t child[kBvhWidth];
  uint32_t unused[8];
};
static_assert(sizeof(BvhNode) == 256, "four cache lines");

}  // namespace swell

#endif  // SWELL_KERNELS_BVH_NODE_H_
