// Closed meshes and rays that must hit them exactly at shared edges and vertices; counts those that
// slip through.
#ifndef SWELL_TESTS_BVH_WATERTIGHT_H_
#define SWELL_TESTS_BVH_WATERTIGHT_H_

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "src/bvh/bvh.h"
#include "tests/support/bvh_scenes.h"

namespace swell::test {

// A closed mesh. What lies within `inner` of the centre is inside, what is farther than `outer` is
// outside.
struct ClosedSurface {
  std::string name;
  Scene scene;
  Float3 centre;
  float inner, outer;
};

// Thin rings of a sphere, a double cone of slivers, a rough ball far from the origin, huge and tiny
// ones, a cube of dyadic squares. `detail` is 1 for quick tests; triangles grow with its square.
std::vector<ClosedSurface> ClosedSurfaces(uint32_t detail);

// Rays whose line passes through a vertex or a point of an edge and through a point inside. From
// inside, they must hit; from outside, they must hit before the point inside, at t = 1.
struct SurfaceRays {
  std::vector<Ray> rays;
  std::vector<float> t_max;  // infinity from inside, 1 from outside
};
SurfaceRays RaysThroughEdges(const ClosedSurface& surface, size_t count, uint32_t seed);

struct Slips {
  uint64_t rays = 0;
  uint64_t slipped = 0;  // in any traversal, as closest-hit or as shadow ray
  std::string example;   // of the first

  void Add(const Slips& other);
};

inline constexpr NamedTraversal kAllTraversals[] = {
    {"auto", Traversal::kAuto}, {"packet", Traversal::kPacket}, {"single", Traversal::kSingle}};

// Traces the rays by each of the traversals.
Slips CountSlips(const ClosedSurface& surface, const Bvh& bvh, Width width, const SurfaceRays& rays,
                 std::span<const NamedTraversal> traversals = kAllTraversals);

}  // namespace swell::test

#endif  // SWELL_TESTS_BVH_WATERTIGHT_H_
