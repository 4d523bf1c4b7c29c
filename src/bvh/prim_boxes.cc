// A scene in, the widened box of every primitive out.
#include "src/bvh/prim_boxes.h"

#include <cmath>

#include "kernels/instance_box.h"
#include "src/bvh/bounds4.h"

namespace swell {
namespace {

float MarginOf(const Box3& box) {
  float most = 0.0f;
  for (int k = 0; k < 3; ++k) most = std::max({most, -box.lower[k], box.upper[k]});
  return most * kBoxMargin;
}

Box3 Widened(Box3 box, float margin) {
  for (int k = 0; k < 3; ++k) {
    box.lower[k] -= margin;
    box.upper[k] += margin;
  }
  return box;
}
Box3 Widened(const Box3& box) { return Widened(box, MarginOf(box)); }

const float* Vertex(const Scene& scene, size_t triangle, size_t k) {
  return &scene.positions[3 * size_t{scene.indices[3 * triangle + k]}];
}

constexpr Box3 kOrigin = {{0, 0, 0}, {0, 0, 0}};
constexpr float kLargestCoordinate = 0x1p60f;

}  // namespace

bool CanBeHit(const Scene& scene, size_t triangle) {
  for (size_t k = 0; k < 3; ++k) {
    const float* p = Vertex(scene, triangle, k);
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
    const float* p = Vertex(scene, triangle, k);
    const Float4 corner = {p[0], p[1], p[2], 0.0f};
    box.AddPoint(corner);
    can_be_hit &= (corner <= kLargestCoordinate) & (corner >= -kLargestCoordinate);
  }
  if ((can_be_hit[0] & can_be_hit[1] & can_be_hit[2]) == 0) return ToBounds4(kOrigin);
  const Float4 most = Max(-box.lower, box.upper);
  const Float4 margin = Splat(std::max({0.0f, most[0], most[1], most[2]}) * kBoxMargin);
  return {box.lower - margin, box.upper + margin};
}

std::pair<Box3, Box3> TriangleParts(const Scene& scene, size_t triangle, int axis, float plane) {
  Box3 whole, left, right;
  bool any_left = false, any_right = false;
  for (size_t k = 0; k < 3; ++k) {
    const float* a = Vertex(scene, triangle, k);
    const float* b = Vertex(scene, triangle, (k + 1) % 3);
    whole.AddPoint(a);
    any_left |= a[axis] < plane;
    any_right |= a[axis] > plane;
    if (a[axis] <= plane) left.AddPoint(a);
    if (a[axis] >= plane) right.AddPoint(a);
    if ((a[axis] < plane) == (b[axis] < plane) || a[axis] == plane || b[axis] == plane) continue;
    const double along = (double{plane} - a[axis]) / (double{b[axis]} - a[axis]);
    float at_plane[3];
    for (int i = 0; i < 3; ++i) {
      at_plane[i] = static_cast<float>(a[i] + along * (double{b[i]} - a[i]));
    }
    left.AddPoint(at_plane);
    right.AddPoint(at_plane);
  }
  // What only touches the plane is part of the other side; what lies in it goes left.
  const float margin = MarginOf(whole);
  if (!any_right) return {Widened(left, margin), Box3()};
  if (!any_left) return {Box3(), Widened(right, margin)};
  return {Widened(left, margin), Widened(right, margin)};
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
  return Widened(box);
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
