// Triangles of polygons: as many as there should be, with the polygon's area.
#include "src/import/polygon.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

namespace swell {
namespace {

using Points = std::vector<std::array<float, 3>>;

std::array<double, 3> AreaVector(const Points& p, const uint32_t* corner) {
  std::array<double, 3> u{}, v{};
  for (size_t k = 0; k < 3; ++k) {
    u[k] = double{p[corner[1]][k]} - p[corner[0]][k];
    v[k] = double{p[corner[2]][k]} - p[corner[0]][k];
  }
  return {(u[1] * v[2] - u[2] * v[1]) / 2, (u[2] * v[0] - u[0] * v[2]) / 2,
          (u[0] * v[1] - u[1] * v[0]) / 2};
}

// Sum of areas, each above 0 if the triangle winds as the polygon around +z does.
void CheckCovers(const Points& points, double area) {
  std::vector<uint32_t> corners;
  Triangulate(points, &corners);
  REQUIRE(corners.size() == 3 * (points.size() - 2));
  double sum = 0.0;
  for (size_t i = 0; i < corners.size(); i += 3) {
    const double z = AreaVector(points, &corners[i])[2];
    CHECK(z > -1e-9);
    sum += z;
  }
  CHECK(sum == doctest::Approx(area));
}

TEST_CASE("Triangulate: convex polygons are fans") {
  std::vector<uint32_t> corners{7};
  Triangulate(Points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, &corners);
  CHECK(corners == std::vector<uint32_t>{7, 0, 1, 2, 0, 2, 3});
  Triangulate(Points{{0, 0, 0}, {1, 0, 0}}, &corners);
  CHECK(corners.size() == 7);
}

TEST_CASE("Triangulate: concave polygons are covered once, in any corner's order") {
  const Points arrow{{0, 0, 0}, {2, -2, 0}, {0, 3, 0}, {-2, -2, 0}};
  const Points comb{{0, 0, 1}, {5, 0, 1}, {5, 3, 1}, {4, 3, 1}, {4, 1, 1},
                    {3, 1, 1}, {3, 3, 1}, {2, 3, 1}, {2, 1, 1}, {0, 1, 1}};
  for (const auto& [shape, area] : {std::pair{arrow, 6.0}, {comb, 9.0}}) {
    for (size_t turn = 0; turn < shape.size(); ++turn) {
      Points turned(shape.begin() + static_cast<ptrdiff_t>(turn), shape.end());
      turned.insert(turned.end(), shape.begin(), shape.begin() + static_cast<ptrdiff_t>(turn));
      CheckCovers(turned, area);
    }
  }
}

TEST_CASE("Triangulate: stars of many corners are covered once") {
  for (const uint32_t n : {10u, 100u, 1000u}) {
    Points star;
    double area = 0.0;
    for (uint32_t i = 0; i < n; ++i) {
      const double angle = 6.283185307179586 * i / n, radius = i % 2 == 0 ? 1.0 : 0.4;
      star.push_back({static_cast<float>(radius * std::cos(angle)),
                      static_cast<float>(radius * std::sin(angle)), 0.0f});
    }
    for (uint32_t i = 0; i < n; ++i) {
      const std::array<float, 3>&p = star[i], &q = star[(i + 1) % n];
      area += (double{p[0]} * q[1] - double{p[1]} * q[0]) / 2;
    }
    CheckCovers(star, area);
  }
}

TEST_CASE("Triangulate: nonsense ends, with as many triangles") {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
  Points points(5000);
  for (auto& point : points) point = {uniform(random), uniform(random), uniform(random)};
  std::vector<uint32_t> corners;
  Triangulate(points, &corners);
  CHECK(corners.size() == 3 * 4998);
  for (auto& point : points) point = {1e38f, -1e38f, 1e38f};
  corners.clear();
  Triangulate(points, &corners);
  CHECK(corners.size() == 3 * 4998);
}

}  // namespace
}  // namespace swell
