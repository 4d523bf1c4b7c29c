// The traversals that `auto` chooses from, by the names of --traversal.
#ifndef SWELL_BENCH_TRAVERSAL_FIXED_TRAVERSALS_H_
#define SWELL_BENCH_TRAVERSAL_FIXED_TRAVERSALS_H_

#include "kernels/bvh_node.h"

namespace swell::bench {

struct FixedTraversal {
  const char* name;
  Traversal traversal;
};
inline constexpr FixedTraversal kFixedTraversals[] = {
    {"packet", Traversal::kPacket},
    {"single", Traversal::kSingle},
};

}  // namespace swell::bench

#endif  // SWELL_BENCH_TRAVERSAL_FIXED_TRAVERSALS_H_
