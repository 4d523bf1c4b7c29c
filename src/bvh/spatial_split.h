// References in, the best plane to cut them by in the surface area heuristic, and their parts, out.
#ifndef SWELL_BVH_SPATIAL_SPLIT_H_
#define SWELL_BVH_SPATIAL_SPLIT_H_

#include <cstdint>
#include <limits>
#include <span>

#include "src/bvh/bounds4.h"
#include "src/scene/scene.h"

namespace swell {

// References are cut at the plane. Stich, Friedrich and Dietrich 2009, "Spatial Splits in Bounding
// Volume Hierarchies".
struct SpatialSplit {
  int axis = -1;  // none: there is nothing to cut
  float plane = 0;
  float cost = std::numeric_limits<float>::infinity();
  Bounds4 left, right;
  float left_weight = 0, right_weight = 0;
};

// About how many references reach over that plane, of those which FindSpatialSplit tries, that most
// reach over. Much cheaper.
float MostCrossing(std::span<const Reference> refs, const Bounds4& box);

// Of many references, the split and what is told of it are a sample's.
SpatialSplit FindSpatialSplit(const Scene& scene, std::span<const Reference> refs,
                              const Bounds4& box);

// What is on either side of a plane; empty where nothing is.
struct CutParts {
  Bounds4 left, right;
};

// The boxes of the parts of a triangle that can be hit, with the whole triangle's margin.
CutParts CutTriangle(const Scene& scene, size_t triangle, int axis, float plane);

// The parts of a reference to a triangle. What does not reach over the plane is not cut.
CutParts CutReference(const Scene& scene, const Reference& ref, int axis, float plane);

}  // namespace swell

#endif  // SWELL_BVH_SPATIAL_SPLIT_H_
