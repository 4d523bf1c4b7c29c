// A scene in, the widened box of every primitive out.
#ifndef SWELL_BVH_PRIM_BOXES_H_
#define SWELL_BVH_PRIM_BOXES_H_

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>

#include "kernels/bvh_node.h"
#include "src/scene/scene.h"

namespace swell {

struct Box3 {
  float lower[3] = {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::infinity(),
                    std::numeric_limits<float>::infinity()};
  float upper[3] = {-std::numeric_limits<float>::infinity(),
                    -std::numeric_limits<float>::infinity(),
                    -std::numeric_limits<float>::infinity()};

  void Add(const Box3& box) {
    for (int k = 0; k < 3; ++k) {
      lower[k] = std::min(lower[k], box.lower[k]);
      upper[k] = std::max(upper[k], box.upper[k]);
    }
  }
  void AddPoint(const float* p) {
    for (int k = 0; k < 3; ++k) {
      lower[k] = std::min(lower[k], p[k]);
      upper[k] = std::max(upper[k], p[k]);
    }
  }
  // Twice the sum over the axes of the centre; only for comparing.
  float Centre(int k) const { return lower[k] + upper[k]; }
  float HalfArea() const {
    const float x = upper[0] - lower[0], y = upper[1] - lower[1], z = upper[2] - lower[2];
    return x * y + y * z + z * x;
  }
};

inline Box3 ChildBox(const BvhNode& node, uint32_t i) {
  Box3 box;
  for (int k = 0; k < 3; ++k) {
    box.lower[k] = node.bounds[k][i];
    box.upper[k] = node.bounds[k + 3][i];
  }
  return box;
}

// False if a coordinate is not finite or so large that areas overflow: the tree keeps such a
// triangle as a point at 0, which no ray hits.
bool CanBeHit(const Scene& scene, size_t triangle);

// The box of triangle i, to the bit as the kernels compute it; the point 0 if it cannot be hit.
Box3 TriangleBox(const Scene& scene, size_t triangle);

// The box of sphere i, rounded outward; the point 0 likewise.
Box3 SphereBox(const SphereRecord& sphere);

// The box of an instance, to the bit as the kernels compute it; nothing if it cannot be hit.
std::optional<Box3> InstanceBox3(const InstanceRecord& instance, const ObjectRecord& object);

// Middle and half extents that hold the box.
ObjectRecord MakeObjectRecord(const Box3& box);

}  // namespace swell

#endif  // SWELL_BVH_PRIM_BOXES_H_
