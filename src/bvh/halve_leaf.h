// The references of a leaf in, boxes that hold them part by part out.
#ifndef SWELL_BVH_HALVE_LEAF_H_
#define SWELL_BVH_HALVE_LEAF_H_

#include <cstddef>
#include <span>

#include "src/bvh/widen.h"

namespace swell {

// Cuts the box of leaf `at` in the middle of its longest side, and the halves again, where both
// parts are less than the whole by `least` in half area. The parts become the leaf's children,
// which name its block: they cost no references, only room in wide nodes.
void HalveLeaf(const Scene& scene, std::span<const Reference> refs, float least, size_t at,
               BinaryTree& tree);

}  // namespace swell

#endif  // SWELL_BVH_HALVE_LEAF_H_
