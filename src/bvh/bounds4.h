// Boxes of four floats an axis end, so that the build's inner loops are vector code.
#ifndef SWELL_BVH_BOUNDS4_H_
#define SWELL_BVH_BOUNDS4_H_

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

#include "src/bvh/prim_boxes.h"

namespace swell {

using Float4 = float __attribute__((vector_size(16)));
using Int4 = int32_t __attribute__((vector_size(16)));

inline Float4 Min(Float4 a, Float4 b) { return a < b ? a : b; }
inline Float4 Max(Float4 a, Float4 b) { return a > b ? a : b; }
inline Float4 Splat(float x) { return Float4{x, x, x, x}; }

// The fourth lane means nothing and is kept finite.
struct Bounds4 {
  Float4 lower = Splat(std::numeric_limits<float>::infinity());
  Float4 upper = Splat(-std::numeric_limits<float>::infinity());

  void Add(const Bounds4& other) {
    lower = Min(lower, other.lower);
    upper = Max(upper, other.upper);
  }
  void AddPoint(Float4 p) {
    lower = Min(lower, p);
    upper = Max(upper, p);
  }
  float HalfArea() const {
    const Float4 d = upper - lower;
    return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
  }
  bool IsEmpty() const {
    const Int4 ordered = lower <= upper;
    return (ordered[0] & ordered[1] & ordered[2]) == 0;
  }
  Box3 ToBox3() const { return {{lower[0], lower[1], lower[2]}, {upper[0], upper[1], upper[2]}}; }
};

inline Bounds4 ToBounds4(const Box3& box) {
  return {Float4{box.lower[0], box.lower[1], box.lower[2], 0.0f},
          Float4{box.upper[0], box.upper[1], box.upper[2], 0.0f}};
}
inline Bounds4 Intersection(const Bounds4& a, const Bounds4& b) {
  return {Max(a.lower, b.lower), Min(a.upper, b.upper)};
}

inline Float4 VertexOf(const Scene& scene, size_t triangle, size_t k) {
  const float* p = &scene.positions[3 * size_t{scene.indices[3 * triangle + k]}];
  return Float4{p[0], p[1], p[2], 0.0f};
}

// How far a primitive's box is widened; see kernels/triangle-inl.h.
inline float MarginOf(const Bounds4& box) {
  const Float4 most = Max(-box.lower, box.upper);
  return std::max({0.0f, most[0], most[1], most[2]}) * kBoxMargin;
}
inline Bounds4 Widened(const Bounds4& box, float margin) {
  return {box.lower - Splat(margin), box.upper + Splat(margin)};
}

// TriangleBox, which is made of this.
Bounds4 TriangleBounds(const Scene& scene, size_t triangle);

// A primitive, or the part of one that a box holds, on its way into the tree. The fourth lanes
// carry the primitive and whether it is a sphere or an instance, which are leaves of their own.
class Reference {
 public:
  Reference() = default;
  Reference(Bounds4 box, uint32_t prim, bool is_sphere) : lower_(box.lower), upper_(box.upper) {
    lower_[3] = std::bit_cast<float>(prim);
    upper_[3] = std::bit_cast<float>(is_sphere ? 1u : 0u);
  }
  Bounds4 box() const { return {FirstThree(lower_), FirstThree(upper_)}; }
  // Twice the centre in one axis; to the bit as from box().
  float CentreOn(int axis) const { return lower_[axis] + upper_[axis]; }
  uint32_t prim() const { return std::bit_cast<uint32_t>(lower_[3]); }
  bool is_sphere() const { return std::bit_cast<uint32_t>(upper_[3]) != 0; }

 private:
  // Arithmetic on arbitrary bits may be slow.
  static Float4 FirstThree(Float4 v) {
    return std::bit_cast<Float4>(std::bit_cast<Int4>(v) & Int4{-1, -1, -1, 0});
  }
  Float4 lower_, upper_;
};
static_assert(sizeof(Reference) == 32);

}  // namespace swell

#endif  // SWELL_BVH_BOUNDS4_H_
