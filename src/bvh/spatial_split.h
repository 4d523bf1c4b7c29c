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

// The parts of a reference on either side of a plane; empty where there is none. Spheres and what
// does not reach over the plane are not cut.
struct CutParts {
  Bounds4 left, right;
};
CutParts CutReference(const Scene& scene, const Reference& ref, int axis, float plane);

}  // namespace swell

#endif  // SWELL_BVH_SPATIAL_SPLIT_H_
