// A triangle and boxes in, whether the boxes together hold all of it out.
#include "src/bvh/covers.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace swell {
namespace {

using Point = std::array<double, 3>;
using Polygon = std::vector<Point>;  // convex; may be a line or a point

struct Interval {
  double lower, upper;
};
using Extent = std::array<Interval, 3>;

Extent ExtentOf(const Polygon& polygon) {
  Extent extent;
  for (size_t axis = 0; axis < 3; ++axis) {
    extent[axis] = {polygon[0][axis], polygon[0][axis]};
    for (const Point& p : polygon) {
      extent[axis].lower = std::min(extent[axis].lower, p[axis]);
      extent[axis].upper = std::max(extent[axis].upper, p[axis]);
    }
  }
  return extent;
}

bool Holds(const Extent& box, const Extent& other) {
  bool holds = true;
  for (size_t axis = 0; axis < 3; ++axis) {
    holds &= box[axis].lower <= other[axis].lower && box[axis].upper >= other[axis].upper;
  }
  return holds;
}

bool AreApart(const Extent& a, const Extent& b) {
  bool apart = false;
  for (size_t axis = 0; axis < 3; ++axis) {
    apart |= a[axis].lower > b[axis].upper || b[axis].lower > a[axis].upper;
  }
  return apart;
}

// What of a polygon is on the side of a plane where sign * (x - at) >= 0.
Polygon Beyond(const Polygon& polygon, size_t axis, double at, double sign) {
  Polygon result;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Point& a = polygon[i];
    const Point& b = polygon[(i + 1) % polygon.size()];
    const double a_side = sign * (a[axis] - at), b_side = sign * (b[axis] - at);
    if (a_side >= 0) result.push_back(a);
    if ((a_side > 0 && b_side < 0) || (a_side < 0 && b_side > 0)) {
      const double along = a_side / (a_side - b_side);
      Point p;
      for (size_t k = 0; k < 3; ++k) p[k] = a[k] + along * (b[k] - a[k]);
      p[axis] = at;
      result.push_back(p);
    }
  }
  return result;
}

struct Plane {
  int axis = -1;  // none
  double at = 0;
};

// The median of the boxes' faces across that axis in which most of them cut the extent.
Plane FindPlane(const Extent& extent, const std::vector<Extent>& boxes) {
  Plane plane;
  std::vector<double> faces, most;
  for (size_t axis = 0; axis < 3; ++axis) {
    faces.clear();
    for (const Extent& box : boxes) {
      for (const double at : {box[axis].lower, box[axis].upper}) {
        if (at > extent[axis].lower && at < extent[axis].upper) faces.push_back(at);
      }
    }
    if (faces.size() <= most.size()) continue;
    plane.axis = static_cast<int>(axis);
    most.swap(faces);
  }
  if (plane.axis < 0) return plane;
  const auto middle = most.begin() + static_cast<std::ptrdiff_t>(most.size() / 2);
  std::nth_element(most.begin(), middle, most.end());
  plane.at = *middle;
  return plane;
}

// Cuts the polygon by faces of boxes until every piece is in one box or, with no face left that
// cuts it, in none. A cut leaves either side at most half of the faces across its axis, so that the
// depth is logarithmic in the number of boxes; the work is about proportional to it where boxes
// overlap little.
bool AreCovering(const std::vector<Extent>& boxes, const Polygon& polygon) {
  const Extent extent = ExtentOf(polygon);
  std::vector<Extent> near;
  for (const Extent& box : boxes) {
    if (Holds(box, extent)) return true;
    if (!AreApart(box, extent)) near.push_back(box);
  }
  const Plane plane = FindPlane(extent, near);
  if (plane.axis < 0) return false;
  const auto axis = static_cast<size_t>(plane.axis);
  return AreCovering(near, Beyond(polygon, axis, plane.at, -1)) &&
         AreCovering(near, Beyond(polygon, axis, plane.at, 1));
}

}  // namespace

bool Covers(std::span<const Box3> boxes, const float* a, const float* b, const float* c,
            double margin) {
  std::vector<Extent> inner;
  for (const Box3& box : boxes) {
    Extent extent;
    bool is_empty = false;
    for (size_t axis = 0; axis < 3; ++axis) {
      extent[axis] = {box.lower[axis] + margin, box.upper[axis] - margin};
      is_empty |= !(extent[axis].lower <= extent[axis].upper);
    }
    if (!is_empty) inner.push_back(extent);
  }
  Polygon triangle;
  for (const float* p : {a, b, c}) triangle.push_back({p[0], p[1], p[2]});
  return AreCovering(inner, triangle);
}

}  // namespace swell
