// Geometry and rays for the tests of building and traversal, and the calls that trace them.
#ifndef SWELL_TESTS_SUPPORT_BVH_SCENES_H_
#define SWELL_TESTS_SUPPORT_BVH_SCENES_H_

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "kernels/intersect_rays.h"
#include "kernels/occlude_rays.h"
#include "src/bvh/bvh.h"
#include "tests/reference/intersect.h"

namespace swell::test {

using Float3 = std::array<float, 3>;
using reference::Ray;

// The standard's engine is the same everywhere, its distributions are not.
class Random {
 public:
  explicit Random(uint32_t seed) : engine_(seed) {}
  uint32_t Bits() { return static_cast<uint32_t>(engine_()); }
  float Uniform(float low = 0.0f, float high = 1.0f) {
    return low + (high - low) * (static_cast<float>(Bits() >> 8) * 0x1p-24f);
  }
  Float3 Point(float low, float high) {
    return {Uniform(low, high), Uniform(low, high), Uniform(low, high)};
  }

 private:
  std::mt19937 engine_;
};

struct NamedScene {
  std::string name;
  Scene scene;
  float low, high;  // rays are made for this range of coordinates
};

void AddTriangle(Scene& scene, const Float3& a, const Float3& b, const Float3& c);
void AddSphere(Scene& scene, const Float3& centre, float radius);
void AddEllipsoid(Scene& scene, const Affine& object_to_world);

// Appends the first triangles and spheres of `part` as an object.
void AddObject(Scene& scene, const Scene& part, uint32_t triangles, uint32_t spheres);
void AddInstance(Scene& scene, const Affine& object_to_world, uint32_t object);

// A closed mesh with shared vertices: a subdivided octahedron, its points moved at random.
Scene ClosedMesh(uint32_t levels, float size, const Float3& centre, uint32_t seed);
Scene TriangleSoup(uint32_t count, float low, float high, float size, uint32_t seed);

// Soups, slivers, shared edges, coplanar duplicates, huge and tiny scales, spheres, a mixture, one
// triangle, nothing.
std::vector<NamedScene> AllScenes();

// Rays of all kinds through a range of coordinates: random, axis-parallel, starting on surfaces,
// aimed at vertices and edges, on faces of boxes, not finite.
std::vector<Ray> RaysFor(const NamedScene& scene, size_t count, uint32_t seed);

// Rays in columns with readable padding.
struct RayTable {
  std::vector<float> columns[6];
  size_t count = 0;

  explicit RayTable(const std::vector<Ray>& rays);
  Vec3Fields<In> org() const { return {columns[0].data(), columns[1].data(), columns[2].data()}; }
  Vec3Fields<In> dir() const { return {columns[3].data(), columns[4].data(), columns[5].data()}; }
};

std::vector<HitFields<Row>> Intersect(const Bvh& bvh, Width width, Traversal traversal,
                                      const RayTable& rays);
// One flag per ray; `use`: what it took, if asked for.
std::vector<bool> Occluded(const Bvh& bvh, Width width, Traversal traversal, const RayTable& rays,
                           const std::vector<float>& t_max, LaneUse* use = nullptr);

// For messages of failed checks.
std::string NameRun(const char* target, Width width, Traversal traversal);

// Same bits in all fields.
bool SameHit(const HitFields<Row>& a, const HitFields<Row>& b);
std::string Describe(const HitFields<Row>& hit);

}  // namespace swell::test

#endif  // SWELL_TESTS_SUPPORT_BVH_SCENES_H_
