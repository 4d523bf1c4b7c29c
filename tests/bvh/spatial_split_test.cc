// CutTriangle against a polygon that is clipped vertex by vertex.
#include "src/bvh/spatial_split.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/support/bvh_scenes.h"

namespace swell::test {
namespace {

using Corners = std::array<Float3, 3>;

// The box of what of a triangle is at or beyond a plane, on its lower side (sign 1) or its upper
// one (sign -1), without margin.
Box3 BoxOfSide(const Corners& corners, int axis, float plane, float sign) {
  Box3 box;
  for (size_t k = 0; k < 3; ++k) {
    const Float3 &a = corners[k], &b = corners[(k + 1) % 3];
    const float from = sign * (a[axis] - plane), to = sign * (b[axis] - plane);
    if (from <= 0) box.AddPoint(a.data());
    if (from * to >= 0) continue;
    const double along = (double{plane} - a[axis]) / (double{b[axis]} - a[axis]);
    float point[3];
    for (size_t i = 0; i < 3; ++i) {
      point[i] = static_cast<float>(a[i] + along * (double{b[i]} - a[i]));
    }
    box.AddPoint(point);
  }
  return box;
}

void CheckPart(const Bounds4& part, const Box3& expected, float margin) {
  for (int k = 0; k < 3; ++k) {
    CHECK(part.lower[k] == expected.lower[k] - margin);
    CHECK(part.upper[k] == expected.upper[k] + margin);
  }
}

// Which sides of the plane it is cut to, as a number from 0 to 3.
size_t CheckCut(const Corners& corners, int axis, float plane) {
  Scene scene;
  AddTriangle(scene, corners[0], corners[1], corners[2]);
  bool below = false, above = false;
  float most = 0;
  for (const Float3& corner : corners) {
    below |= corner[axis] < plane;
    above |= corner[axis] > plane;
    for (const float x : corner) most = std::max(most, std::fabs(x));
  }
  const bool goes_left = below || !above;
  const CutParts parts = CutTriangle(scene, 0, axis, plane);
  CHECK(parts.left.IsEmpty() == !goes_left);
  CHECK(parts.right.IsEmpty() == !above);
  const float margin = most * kBoxMargin;
  if (goes_left) CheckPart(parts.left, BoxOfSide(corners, axis, plane, 1), margin);
  if (above) CheckPart(parts.right, BoxOfSide(corners, axis, plane, -1), margin);
  return (goes_left ? 1 : 0) + (above ? 2 : 0);
}

}  // namespace

TEST_CASE("CutTriangle: the boxes are those of the clipped triangle") {
  Random random(17);
  size_t cut_to[4] = {};
  for (int round = 0; round < 20000; ++round) {
    const Corners corners = {random.Point(-1, 1), random.Point(-1, 1), random.Point(-1, 1)};
    ++cut_to[CheckCut(corners, round % 3, random.Uniform(-1, 1))];
  }
  for (size_t sides = 1; sides < 4; ++sides) CHECK(cut_to[sides] > 4000);
}

TEST_CASE("CutTriangle: vertices, edges and triangles in the plane") {
  const auto grid = [](int i) -> Float3 {
    return {static_cast<float>(i % 3), static_cast<float>(i / 3 % 3), static_cast<float>(i / 9)};
  };
  size_t in_plane = 0;
  for (int i = 0; i < 27 * 27 * 27; ++i) {
    const Corners corners = {grid(i % 27), grid(i / 27 % 27), grid(i / 729)};
    for (int axis = 0; axis < 3; ++axis) {
      CheckCut(corners, axis, 1);
      in_plane += corners[0][axis] == 1 && corners[1][axis] == 1 && corners[2][axis] == 1;
    }
  }
  CHECK(in_plane == 3 * 729);
}

}  // namespace swell::test
