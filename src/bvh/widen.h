// A binary tree in, wide nodes and leaf blocks out.
#ifndef SWELL_BVH_WIDEN_H_
#define SWELL_BVH_WIDEN_H_

#include "src/bvh/build_sah.h"
#include "src/bvh/bvh.h"

namespace swell {

// One node without children.
void MakeEmpty(Bvh& bvh);

// Fills nodes, blocks, depth and max_abs_coord.
void Widen(const BinaryTree& tree, const Scene& scene, Bvh& bvh);

}  // namespace swell

#endif  // SWELL_BVH_WIDEN_H_
