// A scene in, the widened box of every primitive out.
#include "src/bvh/prim_boxes.h"

#include <cmath>

#include "kernels/instance_box.h"
#include "src/bvh/bounds4.h"

namespace swell {
namespace {

constexpr Box3 kOrigin = {{0, 0, 0}, {0, 0, 0}};
constexpr float kLargestCoordinate = 0x1p60f;

}  // namespace

bool CanBeHit(const Scene& scene, size_t triangle) {
  for (size_t k = 0; k < 3; ++k) {
    const Float4 p = VertexOf(scene, triangle, k);
    for (int axis = 0; axis < 3; ++axis) {
      if (!(std::fabs(p[axis]) <= kLargestCoordinate)) return false;
    }
  }
  return true;
}

Box3 TriangleBox(const Scene& scene, size_t triangle) {
  return TriangleBounds(scene, triangle).ToBox3();
}

Bounds4 TriangleBounds(const Scene& scene, size_t triangle) {
  Bounds4 box;
  Int4 can_be_hit = {-1, -1, -1, -1};
  for (size_t k = 0; k < 3; ++k) {
    const Float4 corner = VertexOf(scene, triangle, k);
    box.AddPoint(corner);
    can_be_hit &= (corner <= kLargestCoordinate) & (corner >= -kLargestCoordinate);
  }
  if ((can_be_hit[0] & can_be_hit[1] & can_be_hit[2]) == 0) return ToBounds4(kOrigin);
  return Widened(box, MarginOf(box));
}

Box3 SphereBox(const SphereRecord& sphere) {
  Box3 box;
  for (int k = 0; k < 3; ++k) {
    const float* row = &sphere.object_to_world[4 * k];
    const double x = row[0], y = row[1], z = row[2], centre = row[3];
    const double extent = std::sqrt(x * x + y * y + z * z);
    if (!(std::fabs(centre) + extent <= kLargestCoordinate)) return kOrigin;
    box.lower[k] = std::nextafter(static_cast<float>(centre - extent), -HUGE_VALF);
    box.upper[k] = std::nextafter(static_cast<float>(centre + extent), HUGE_VALF);
  }
  const Bounds4 bounds = ToBounds4(box);
  return Widened(bounds, MarginOf(bounds)).ToBox3();
}

std::optional<Box3> InstanceBox3(const InstanceRecord& instance, const ObjectRecord& object) {
  Box3 box;
  float bounds[6];
  InstanceBox(instance, object, bounds);
  for (int k = 0; k < 3; ++k) {
    box.lower[k] = bounds[k];
    box.upper[k] = bounds[k + 3];
    if (!(-kLargestCoordinate <= bounds[k] && bounds[k + 3] <= kLargestCoordinate)) {
      return std::nullopt;
    }
  }
  return box;
}

ObjectRecord MakeObjectRecord(const Box3& box) {
  ObjectRecord object{};
  for (int k = 0; k < 3; ++k) {
    object.middle[k] = 0.5f * box.lower[k] + 0.5f * box.upper[k];
    const float half = std::max(box.upper[k] - object.middle[k], object.middle[k] - box.lower[k]);
    object.half[k] = std::nextafter(half, HUGE_VALF);
  }
  return object;
}

}  // namespace swell
