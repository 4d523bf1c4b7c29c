// A triangle and boxes in, whether the boxes together hold all of it out.
#include "src/bvh/covers.h"

#include <array>
#include <cmath>
#include <vector>

namespace swell {
namespace {

using Point = std::array<double, 3>;
using Polygon = std::vector<Point>;  // convex; may be a line or a point

// What of a polygon is on the side of a plane where sign * (x - at) > 0; nothing if only its border
// is. The border comes along.
Polygon Beyond(const Polygon& polygon, size_t axis, double at, double sign) {
  Polygon result;
  bool any = false;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Point& a = polygon[i];
    const Point& b = polygon[(i + 1) % polygon.size()];
    const double a_side = sign * (a[axis] - at), b_side = sign * (b[axis] - at);
    any |= a_side > 0;
    if (a_side >= 0) result.push_back(a);
    if ((a_side > 0 && b_side < 0) || (a_side < 0 && b_side > 0)) {
      const double along = a_side / (a_side - b_side);
      Point p;
      for (size_t k = 0; k < 3; ++k) p[k] = a[k] + along * (b[k] - a[k]);
      p[axis] = at;
      result.push_back(p);
    }
  }
  return any ? result : Polygon();
}

bool AreApart(const Polygon& polygon, const Box3& box) {
  for (size_t axis = 0; axis < 3; ++axis) {
    bool all_below = true, all_above = true;
    for (const Point& p : polygon) {
      all_below &= p[axis] < box.lower[axis];
      all_above &= p[axis] > box.upper[axis];
    }
    if (all_below || all_above) return true;
  }
  return false;
}

}  // namespace

bool Covers(std::span<const Box3> boxes, const float* a, const float* b, const float* c,
            double margin) {
  Polygon triangle;
  for (const float* p : {a, b, c}) triangle.push_back({p[0], p[1], p[2]});
  std::vector<Polygon> left = {triangle};
  for (const Box3& box : boxes) {
    std::vector<Polygon> outside;
    for (Polygon& polygon : left) {
      if (AreApart(polygon, box)) {
        outside.push_back(std::move(polygon));
        continue;
      }
      Polygon inside = std::move(polygon);
      for (size_t axis = 0; axis < 3 && !inside.empty(); ++axis) {
        const double lower = box.lower[axis] + margin, upper = box.upper[axis] - margin;
        if (lower > upper) return false;
        if (Polygon p = Beyond(inside, axis, lower, -1); !p.empty()) outside.push_back(p);
        inside = Beyond(inside, axis, std::nextafter(lower, -HUGE_VAL), 1);
        if (inside.empty()) break;
        if (Polygon p = Beyond(inside, axis, upper, 1); !p.empty()) outside.push_back(p);
        inside = Beyond(inside, axis, std::nextafter(upper, HUGE_VAL), -1);
      }
    }
    left = std::move(outside);
    if (left.empty()) return true;
  }
  return left.empty();
}

}  // namespace swell
