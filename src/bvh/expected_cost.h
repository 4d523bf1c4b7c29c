// A tree in, what a ray is expected to spend in it out.
#ifndef SWELL_BVH_EXPECTED_COST_H_
#define SWELL_BVH_EXPECTED_COST_H_

#include <cstddef>

#include "src/bvh/bvh.h"

namespace swell {

// The surface area heuristic's expectation for a ray that crosses the scene's box anywhere: it
// enters a box below with the ratio of the two areas. What it leaves out is the same for all trees:
// rays that end early, order, and where rays go in the picture.
struct ExpectedCost {
  double nodes = 0.0;      // visited, the root for certain
  double blocks = 0.0;     // tests of up to kBlockWidth triangles, or of one sphere
  double triangles = 0.0;  // of these leaves, with those before them in their blocks
  size_t node_count = 0;
  size_t block_count = 0, reference_count = 0;  // blocks and spheres; what is in them

  // In visits of a node of kBvhWidth children.
  double Total(double block_cost) const { return nodes + block_cost * blocks; }
};

// Of a test of a block, in visits of a node: eight triangles against eight boxes and their order.
inline constexpr double kBlockCost = 1.0;

ExpectedCost FindExpectedCost(const Bvh& bvh);

}  // namespace swell

#endif  // SWELL_BVH_EXPECTED_COST_H_
