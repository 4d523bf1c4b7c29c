// References in, the best plane to part them by in the surface area heuristic out.
#ifndef SWELL_BVH_FIND_SPLIT_H_
#define SWELL_BVH_FIND_SPLIT_H_

#include <cstdint>
#include <limits>
#include <span>

#include "kernels/bvh_node.h"
#include "src/bvh/bounds4.h"
#include "src/scene/scene.h"

namespace swell {

struct RefCount {
  uint32_t triangles = 0, spheres = 0;

  void Add(const RefCount& other) {
    triangles += other.triangles;
    spheres += other.spheres;
  }
  uint32_t all() const { return triangles + spheres; }
  // Tests of a block or a sphere that they take.
  float Tests() const {
    return static_cast<float>((triangles + kBlockWidth - 1) / kBlockWidth + spheres);
  }
};

// What a node knows of its references.
struct RefBounds {
  Bounds4 box;
  Bounds4 centres;  // of CentreOf
  uint32_t spheres = 0;

  void Add(const RefBounds& other) {
    box.Add(other.box);
    centres.Add(other.centres);
    spheres += other.spheres;
  }
};
RefBounds BoundsOf(std::span<const Reference> refs);

// Twice the centre; only for comparing.
inline Float4 CentreOf(const Bounds4& box) { return box.lower + box.upper; }

// Maps points to bins; monotone.
struct BinMap {
  Float4 lower, scale;
  uint32_t bins;

  BinMap(const Bounds4& range, uint32_t bins_asked);
  Int4 BinsOf(Float4 point) const { return __builtin_convertvector((point - lower) * scale, Int4); }
};

// References whose centre's bin is below `bin` go left.
struct ObjectSplit {
  int axis = -1;  // none: all centres coincide
  int bin = 0;
  float cost = std::numeric_limits<float>::infinity();  // half area times tests
  Bounds4 left, right;
};
ObjectSplit FindObjectSplit(std::span<const Reference> refs, const BinMap& map);

// References are cut at the plane. Stich, Friedrich and Dietrich 2009, "Spatial Splits in Bounding
// Volume Hierarchies".
struct SpatialSplit {
  int axis = -1;  // none: there is nothing to cut
  float plane = 0;
  float cost = std::numeric_limits<float>::infinity();
  Bounds4 left, right;
  RefCount left_count, right_count;
};
// About how many references reach over that plane, of those which FindSpatialSplit tries, that most
// reach over. Much cheaper.
uint32_t MostCrossing(std::span<const Reference> refs, const Bounds4& box);

SpatialSplit FindSpatialSplit(const Scene& scene, std::span<const Reference> refs,
                              const Bounds4& box);

// The parts of a reference on either side of a plane; empty where there is none. Spheres and what
// does not reach over the plane are not cut.
struct CutParts {
  Bounds4 left, right;
};
CutParts CutReference(const Scene& scene, const Reference& ref, int axis, float plane);

}  // namespace swell

#endif  // SWELL_BVH_FIND_SPLIT_H_
