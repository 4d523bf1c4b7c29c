// References to primitives in, a binary tree by the surface area heuristic out, widened part by
// part.
#ifndef SWELL_BVH_BUILD_SAH_H_
#define SWELL_BVH_BUILD_SAH_H_

#include <cstdint>
#include <memory>
#include <span>

#include "src/bvh/bounds4.h"
#include "src/bvh/bvh.h"
#include "src/bvh/widen.h"

namespace swell {

// Levels of the binary tree, which bounds the levels of the wide one.
inline constexpr uint32_t kMaxBinaryDepth = kMaxBvhDepth;

// `refs` must not be empty; its content is used up.
std::unique_ptr<UpperNode> BuildSah(const Scene& scene, std::span<Reference> refs,
                                    const BuildOptions& options);

}  // namespace swell

#endif  // SWELL_BVH_BUILD_SAH_H_
