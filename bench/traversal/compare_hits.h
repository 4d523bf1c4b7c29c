// The hits of swell and of a peer for the same rays in, where they differ and why out.
#ifndef SWELL_BENCH_TRAVERSAL_COMPARE_HITS_H_
#define SWELL_BENCH_TRAVERSAL_COMPARE_HITS_H_

#include <cstdint>
#include <string>

#include "bench/traversal/peer.h"
#include "bench/traversal/ray_sets.h"
#include "src/bvh/bvh.h"

namespace swell::bench {

// Rays whose answers differ, by reason. Distances are those of double precision.
struct Differences {
  uint64_t rows = 0;            // compared
  uint64_t coplanar = 0;        // both hits exist, at one distance
  uint64_t shared_edge = 0;     // likewise, on the edge or the vertex of neighbours
  uint64_t below_rounding = 0;  // the nearer hit is closer to its triangle's edge, or to an end of
                                // the ray, than coordinates round
  uint64_t distance = 0;        // one primitive, one of the distances off by more than that
  uint64_t other = 0;           // an engine is wrong: in its primitive, or a miss
  std::string example;          // of the last two
  // Rows at which a fixed traversal does not give the bytes of `auto`.
  uint64_t traversals_differ = 0;

  uint64_t total() const { return coplanar + shared_edge + below_rounding + distance + other; }
  double per_million() const {
    return 1e6 * static_cast<double>(total()) / static_cast<double>(rows);
  }
};

// `robust` is a peer's scene in its robust mode. Closest hits: the primitive; shadow rays: whether
// there is one.
Differences CompareHits(const Scene& scene, const RaySet& set, const Bvh& bvh,
                        const PeerScene& robust);

}  // namespace swell::bench

#endif  // SWELL_BENCH_TRAVERSAL_COMPARE_HITS_H_
