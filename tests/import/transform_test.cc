// Affine maps against hand-computed images.
#include "src/import/transform.h"

#include <doctest/doctest.h>

namespace swell {
namespace {

void CheckNear(const Point& got, const Point& expected) {
  for (size_t c = 0; c < 3; ++c) CHECK(got[c] == doctest::Approx(expected[c]).epsilon(1e-12));
}

}  // namespace

TEST_CASE("Rotate: is right-handed, and exact for quarter turns") {
  CHECK(MapPoint(Rotate(90, {0, 0, 1}), {1, 0, 0}) == Point{0, 1, 0});
  CHECK(MapPoint(Rotate(90, {5, 0, 0}), {0, 1, 0}) == Point{0, 0, 1});
  CHECK(MapPoint(Rotate(180, {0, 1, 0}), {1, 0, 0}) == Point{-1, 0, 0});
  CheckNear(MapPoint(Rotate(120, {1, 1, 1}), {1, 2, 3}), {3, 1, 2});
}

TEST_CASE("operator*: applies the right map first") {
  CHECK(MapPoint(Translate(1, 0, 0) * Scale(2, 2, 2), {1, 1, 1}) == Point{3, 2, 2});
  CHECK(MapPoint(Scale(2, 2, 2) * Translate(1, 0, 0), {1, 1, 1}) == Point{4, 2, 2});
}

TEST_CASE("LookAt: puts the eye at the origin, the target on +z, +x to the right of up") {
  const auto camera = LookAt({1, 2, 3}, {1, 2, 8}, {0, 1, 0});
  REQUIRE(camera);
  CheckNear(MapPoint(*camera, {1, 2, 3}), {0, 0, 0});
  CheckNear(MapPoint(*camera, {1, 2, 8}), {0, 0, 5});
  CheckNear(MapPoint(*camera, {2, 3, 3}), {1, 1, 0});  // left-handed, as pbrt
  CHECK(!LookAt({0, 0, 0}, {0, 0, 0}, {0, 1, 0}));
  CHECK(!LookAt({0, 0, 0}, {0, 3, 0}, {0, 1, 0}));
  CHECK(!LookAt({0, 0, 0}, {0, 0, 1}, {0, 0, 0}));
}

TEST_CASE("Inverse: undoes the map at any scale and refuses flat ones") {
  for (double scale : {1e-12, 1.0, 1e12}) {
    const Transform t =
        Translate(scale, -scale, 0) * Rotate(33, {1, 2, 3}) * Scale(scale, -scale, scale);
    const auto inverse = Inverse(t);
    REQUIRE(inverse);
    CheckNear(MapPoint(*inverse, MapPoint(t, {0.25, 0.5, 1})), {0.25, 0.5, 1});
    CHECK(Determinant(t) < 0);
  }
  CHECK(!Inverse(Scale(1, 0, 1)));
  CHECK(!Inverse(Transform{{1, 2, 3, 0, 2, 4, 6, 0, 0, 0, 1, 0}}));
}

}  // namespace swell
