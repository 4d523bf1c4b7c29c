// Covers on the parts of triangles cut at random, on many boxes, and on degenerate ones.
#include "src/bvh/covers.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "src/bvh/spatial_split.h"
#include "tests/support/bvh_scenes.h"

namespace swell::test {
namespace {

const float* Vertex(const Scene& scene, size_t k) {
  return &scene.positions[3 * size_t{scene.indices[k]}];
}

double MarginOf(const Scene& scene) {
  float most = 0;
  for (const float x : scene.positions) most = std::max(most, std::fabs(x));
  return 0.875 * most * kBoxMargin;
}

bool IsCovered(const Scene& scene, const std::vector<Box3>& boxes) {
  return Covers(boxes, Vertex(scene, 0), Vertex(scene, 1), Vertex(scene, 2), MarginOf(scene));
}

// The boxes of a scene's one triangle, cut `cuts` times as the builder does.
std::vector<Box3> RandomParts(const Scene& scene, int cuts, Random& random) {
  std::vector<Bounds4> parts = {TriangleBounds(scene, 0)};
  for (int i = 0; i < cuts; ++i) {
    const size_t at = random.Bits() % parts.size();
    const int axis = static_cast<int>(random.Bits() % 3);
    const float plane = random.Uniform(parts[at].lower[axis], parts[at].upper[axis]);
    const CutParts cut = CutReference(scene, Reference(parts[at], 0, false), axis, plane);
    if (cut.left.IsEmpty() || cut.right.IsEmpty()) continue;
    parts[at] = cut.left;
    parts.push_back(cut.right);
  }
  std::vector<Box3> boxes;
  for (const Bounds4& part : parts) boxes.push_back(part.ToBox3());
  return boxes;
}

bool Holds(const Box3& box, const double (&p)[3], double margin) {
  for (int k = 0; k < 3; ++k) {
    if (!(p[k] >= box.lower[k] + margin && p[k] <= box.upper[k] - margin)) return false;
  }
  return true;
}

// The boxes that hold some point of the triangle, and that point.
std::vector<size_t> HoldersOfPoint(const Scene& scene, const std::vector<Box3>& boxes,
                                   Random& random, double (&point)[3]) {
  double u = random.Uniform(), v = random.Uniform();
  if (u + v > 1) u = 1 - u, v = 1 - v;
  for (int k = 0; k < 3; ++k) {
    point[k] =
        (1 - u - v) * Vertex(scene, 0)[k] + u * Vertex(scene, 1)[k] + v * Vertex(scene, 2)[k];
  }
  std::vector<size_t> holders;
  for (size_t i = 0; i < boxes.size(); ++i) {
    if (Holds(boxes[i], point, MarginOf(scene))) holders.push_back(i);
  }
  return holders;
}

// A floor of side by side cells, the triangle over all of it.
std::vector<Box3> Floor(int side, float margin) {
  std::vector<Box3> boxes;
  for (int i = 0; i < side * side; ++i) {
    const auto x = static_cast<float>(i % side), z = static_cast<float>(i / side);
    boxes.push_back({{x - margin, -margin, z - margin}, {x + 1 + margin, margin, z + 1 + margin}});
  }
  return boxes;
}

}  // namespace

TEST_CASE("Covers: parts hold their triangle, and do not without one that a point is in alone") {
  Random random(90);
  size_t without = 0, smaller = 0;
  for (int round = 0; round < 200; ++round) {
    Scene scene;
    const Float3 a = random.Point(-1, 1), b = random.Point(-1, 1);
    const float width = std::pow(10.0f, -6.0f * random.Uniform());
    const Float3 shift = random.Point(-width, width);
    AddTriangle(scene, a, b, {b[0] + shift[0], b[1] + shift[1], b[2] + shift[2]});
    const std::vector<Box3> boxes = RandomParts(scene, 60, random);
    REQUIRE(boxes.size() > 2);
    REQUIRE(IsCovered(scene, boxes));
    for (int i = 0; i < 20; ++i) {
      double point[3];
      const std::vector<size_t> holders = HoldersOfPoint(scene, boxes, random, point);
      REQUIRE(!holders.empty());
      if (holders.size() > 1) continue;
      std::vector<Box3> fewer = boxes;
      fewer.erase(fewer.begin() + static_cast<ptrdiff_t>(holders[0]));
      CHECK_FALSE(IsCovered(scene, fewer));
      ++without;
      std::vector<Box3> cut = boxes;
      const size_t axis = random.Bits() % 3;
      cut[holders[0]].lower[axis] = std::nextafter(static_cast<float>(point[axis]), 2.0f);
      CHECK_FALSE(IsCovered(scene, cut));
      ++smaller;
    }
  }
  CHECK(without > 1000);
  CHECK(smaller > 1000);
}

TEST_CASE("Covers: a hundred thousand boxes end soon, and one that lacks is missed") {
  constexpr int kSide = 320;
  const float a[] = {0, 0, 0}, b[] = {kSide, 0, 0}, c[] = {0, 0, kSide};
  const float margin = kSide * kBoxMargin;
  std::vector<Box3> boxes = Floor(kSide, margin);
  Random random(91);
  for (size_t i = boxes.size(); i > 1; --i) std::swap(boxes[i - 1], boxes[random.Bits() % i]);
  CHECK(Covers(boxes, a, b, c, margin));
  CHECK_FALSE(Covers(boxes, a, b, c, margin * 1.01));
  for (int i = 0; i < 5; ++i) {
    const size_t at = random.Bits() % boxes.size();
    if (boxes[at].lower[0] + boxes[at].lower[2] >= kSide - 1) continue;
    const Box3 lost = std::exchange(boxes[at], boxes[(at + 1) % boxes.size()]);
    CHECK_FALSE(Covers(boxes, a, b, c, margin));
    boxes[at] = lost;
  }
}

TEST_CASE("Covers: boxes that all overlap end soon") {
  const float a[] = {0, 0, 0}, b[] = {1, 0, 0}, c[] = {0, 0, 1};
  Random random(92);
  std::vector<Box3> boxes;
  for (int i = 0; i < 2000; ++i) {
    const float x = random.Uniform(-1, 0.9f), z = random.Uniform(-1, 0.9f);
    boxes.push_back({{x, -1, z}, {x + 1, 1, z + 1}});
  }
  for (Box3& box : boxes) box.lower[0] = std::max(box.lower[0], 1e-3f);
  CHECK_FALSE(Covers(boxes, a, b, c, 0));
  boxes.push_back({{-1, -1, -1}, {1e-3f, 1, 2}});
  boxes.push_back({{-1, -1, -1}, {2, 1, 2}});
  CHECK(Covers(boxes, a, b, c, 0));
}

TEST_CASE("Covers: points, lines and triangles in the plane of a face are held by it") {
  const Box3 left = {{0, 0, 0}, {1, 1, 1}}, right = {{1, 0, 0}, {2, 1, 1}};
  const std::vector<Box3> both = {left, right}, one = {left};
  const float p[] = {1, 0.5f, 0.5f}, q[] = {0.5f, 0, 0}, r[] = {1.5f, 1, 1}, s[] = {1, 0, 1};
  const float outside[] = {1, 1.0000001f, 0.5f};
  CHECK(Covers(one, p, p, p, 0));
  CHECK(Covers(one, p, s, p, 0));
  CHECK(Covers(one, p, s, p, 0));
  CHECK(Covers(one, p, p, s, 0));
  CHECK(Covers(both, q, r, q, 0));
  CHECK(Covers(both, q, r, s, 0));
  CHECK_FALSE(Covers(one, q, r, q, 0));
  CHECK_FALSE(Covers(one, q, r, s, 0));
  CHECK_FALSE(Covers(both, outside, p, s, 0));
  CHECK_FALSE(Covers(both, outside, outside, outside, 0));
  CHECK_FALSE(Covers({}, p, p, p, 0));
}

TEST_CASE("Covers: a box that is thinner than its margins holds nothing and harms nothing") {
  const float a[] = {0.25f, 0.5f, 0.25f}, b[] = {0.75f, 0.5f, 0.25f}, c[] = {0.25f, 0.5f, 0.75f};
  const Box3 whole = {{0, 0, 0}, {1, 1, 1}}, thin = {{0, 0.45f, 0}, {1, 0.55f, 1}};
  const std::vector<Box3> first = {thin, whole}, alone = {thin};
  CHECK(Covers(first, a, b, c, 0.125));
  CHECK_FALSE(Covers(alone, a, b, c, 0.125));
}

}  // namespace swell::test
