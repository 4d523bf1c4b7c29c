// A triangle and boxes in, whether the boxes together hold all of it out.
#ifndef SWELL_BVH_COVERS_H_
#define SWELL_BVH_COVERS_H_

#include <span>

#include "src/bvh/prim_boxes.h"

namespace swell {

// True if every point of the triangle is in a box at least `margin` away from its faces.
bool Covers(std::span<const Box3> boxes, const float* a, const float* b, const float* c,
            double margin);

}  // namespace swell

#endif  // SWELL_BVH_COVERS_H_
