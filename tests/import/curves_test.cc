// Cylinders, curves and subdivision surfaces: their meshes lie where the shapes do.
#include <algorithm>
#include <array>
#include <cmath>

#include "src/import/subdivide.h"
#include "tests/import/scene_texts.h"

namespace swell {
namespace {

constexpr double kPi = 3.14159265358979;

Scene Lit(const std::string& text) { return test::WorldOf("LightSource \"infinite\"\n" + text); }

Point RowOf(const std::vector<float>& values, size_t row) {
  return {values[3 * row], values[3 * row + 1], values[3 * row + 2]};
}
Point Minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double Length(const Point& p) { return std::sqrt(Dot(p, p)); }

double AreaOf(const Scene& scene) {
  double area = 0.0;
  for (size_t i = 0; i < scene.triangle_count(); ++i) {
    const uint32_t* v = &scene.indices[3 * i];
    const Point a = RowOf(scene.positions, v[0]);
    area += 0.5 * Length(Cross(Minus(RowOf(scene.positions, v[1]), a),
                               Minus(RowOf(scene.positions, v[2]), a)));
  }
  return area;
}

// The mesh of a file's only shape must face to where its vertices' normals do.
void CheckWinding(const Scene& scene) {
  for (size_t i = 0; i < scene.triangle_count(); ++i) {
    const uint32_t* v = &scene.indices[3 * i];
    const Point a = RowOf(scene.positions, v[0]);
    const Point n =
        Cross(Minus(RowOf(scene.positions, v[1]), a), Minus(RowOf(scene.positions, v[2]), a));
    CHECK(Dot(n, RowOf(scene.normals, v[0])) > 0.0);
  }
}

const std::string kArc = "\"point3 P\" [1 0 0  1 .5522847 0  .5522847 1 0  0 1 0] ";

}  // namespace

TEST_CASE("shapes: a cylinder has its area, its normals point outward, u runs around it") {
  const Scene scene =
      Lit("Shape \"cylinder\" \"float radius\" 2 \"float zmin\" 3 \"float zmax\" 1");
  CHECK(AreaOf(scene) == doctest::Approx(2.0 * kPi * 2.0 * 2.0).epsilon(1e-5));
  CheckWinding(scene);
  for (size_t v = 0; v < scene.positions.size() / 3; ++v) {
    const Point p = RowOf(scene.positions, v), n = RowOf(scene.normals, v);
    CHECK(std::hypot(p[0], p[1]) == doctest::Approx(2.0).epsilon(1e-3));
    CHECK(n[0] * p[0] + n[1] * p[1] == doctest::Approx(2.0).epsilon(1e-3));
    CHECK((p[2] == 1.0 || p[2] == 3.0));
    CHECK(scene.uvs[2 * v + 1] == (p[2] == 1.0 ? 0.0f : 1.0f));
  }
  const Scene half = Lit("Shape \"cylinder\" \"float phimax\" 180");
  CHECK(AreaOf(half) == doctest::Approx(2.0 * kPi).epsilon(1e-5));
}

TEST_CASE("shapes: a tube's surface is half its width from its curve, outward") {
  const Scene scene =
      Lit("Shape \"curve\" \"string type\" \"cylinder\" \"float width\" 0.1 " + kArc);
  REQUIRE(scene.triangle_count() > 0);
  CheckWinding(scene);
  for (size_t v = 0; v < scene.positions.size() / 3; ++v) {
    const Point p = RowOf(scene.positions, v);
    // The arc is a quarter of the unit circle, to 3e-4.
    CHECK(std::hypot(std::hypot(p[0], p[1]) - 1.0, p[2]) == doctest::Approx(0.05).epsilon(0.06));
  }
  CHECK(AreaOf(scene) == doctest::Approx(kPi * 0.1 * kPi / 2).epsilon(0.06));
  CHECK(scene.warnings.empty());
}

TEST_CASE("shapes: narrower curves get more chords, straight ones have one") {
  const auto triangles = [](const std::string& text) {
    return Lit("Shape \"curve\" \"string type\" \"cylinder\" " + text).triangle_count();
  };
  const size_t wide = triangles("\"float width\" 0.1 " + kArc);
  const size_t narrow = triangles("\"float width\" 0.001 " + kArc);
  CHECK(narrow > 8 * wide);
  CHECK(triangles("\"point3 P\" [0 0 0 1 0 0 2 0 0 3 0 0]") == 16);
}

TEST_CASE("shapes: a ribbon lies across its normals, with its widths") {
  const Scene scene =
      Lit("Shape \"curve\" \"string type\" \"ribbon\" \"float width0\" 1 \"float width1\" 3 "
          "\"normal N\" [0 0 1 0 0 1] \"point3 P\" [0 0 0 1 0 0 2 0 0 3 0 0]");
  CHECK(scene.triangle_count() == 2);
  CHECK(AreaOf(scene) == doctest::Approx(6.0));
  CheckWinding(scene);
  CHECK(RowOf(scene.normals, 0)[2] == doctest::Approx(1.0));
}

TEST_CASE("shapes: the four ways to write a curve describe the same one") {
  const auto middle = [](const std::string& text) {
    const Scene scene = Lit("Shape \"curve\" \"float width\" 1e-3 " + text);
    Point sum{};
    const size_t rows = scene.positions.size() / 3;
    for (size_t v = rows - 9; v < rows - 1; ++v) {  // the last ring
      for (size_t c = 0; c < 3; ++c) sum[c] += RowOf(scene.positions, v)[c] / 8.0;
    }
    return sum;
  };
  const auto check = [&](const std::string& text, const Point& expected) {
    const Point got = middle(text);
    CAPTURE(text);
    for (size_t c = 0; c < 3; ++c) CHECK(got[c] == doctest::Approx(expected[c]).epsilon(1e-3));
  };
  const std::string points = "\"point3 P\" [0 0 0  1 2 0  3 2 0  4 0 0] ";
  check(points, {4, 0, 0});
  check("\"string basis\" \"bspline\" " + points, {(1 + 12 + 4) / 6.0, (2 + 8 + 0) / 6.0, 0});
  check("\"integer degree\" 2 \"point3 P\" [0 0 0 1 2 0 3 2 0]", {3, 2, 0});
  check("\"integer degree\" 2 \"string basis\" \"bspline\" " + points, {3.5, 1, 0});
}

TEST_CASE("shapes: subdivision brings a tetrahedron's faces to a smooth closed surface") {
  const std::string tetrahedron =
      "\"integer indices\" [0 2 1  0 1 3  1 2 3  0 3 2] "
      "\"point3 P\" [1 1 1  1 -1 -1  -1 1 -1  -1 -1 1] ";
  const Scene scene = Lit("Shape \"loopsubdiv\" \"integer levels\" 4 " + tetrahedron);
  CHECK(scene.triangle_count() == 4 * 256);
  double least = 1e9, most = 0.0, worst = 1.0;
  for (size_t v = 0; v < scene.positions.size() / 3; ++v) {
    const Point p = RowOf(scene.positions, v), n = RowOf(scene.normals, v);
    least = std::min(least, Length(p));
    most = std::max(most, Length(p));
    worst = std::min(worst, std::abs(Dot(p, n)) / Length(p));
  }
  CHECK(most < 1.0);
  CHECK(least > 0.2);
  CHECK(worst > 0.7);
  // The limit does not depend on the level at which it is taken.
  const Scene coarse = Lit("Shape \"loopsubdiv\" \"integer levels\" 2 " + tetrahedron);
  for (size_t v = 0; v < 4; ++v) {
    for (size_t c = 0; c < 3; ++c) {
      CHECK(RowOf(coarse.positions, v)[c] == doctest::Approx(RowOf(scene.positions, v)[c]));
      CHECK(RowOf(coarse.normals, v)[c] ==
            doctest::Approx(RowOf(scene.normals, v)[c]).epsilon(1e-4));
    }
  }
}

TEST_CASE("shapes: a flat subdivided mesh stays in its plane, and its boundary on its edges") {
  ControlMesh square;
  square.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0},
                   {2, 1, 0}, {0, 2, 0}, {1, 2, 0}, {2, 2, 0}};
  for (uint32_t y = 0; y < 2; ++y) {
    for (uint32_t x = 0; x < 2; ++x) {
      const uint32_t a = 3 * y + x;
      square.faces.push_back({a, a + 1, a + 4});
      square.faces.push_back({a, a + 4, a + 3});
    }
  }
  for (int levels = 0; levels < 4; ++levels) {
    CAPTURE(levels);
    const Result<SmoothMesh> mesh = SubdivideLoop(square, levels);
    REQUIRE(mesh);
    CHECK(mesh->faces.size() == 8u << (2 * levels));
    for (size_t v = 0; v < mesh->points.size(); ++v) {
      CHECK(mesh->points[v][2] == 0.0);
      CHECK(*Normalized(mesh->normals[v]) == Point{0, 0, 1});
    }
    CHECK(mesh->points[4][0] == doctest::Approx(1.0));
    CHECK(mesh->points[1][1] == 0.0);  // the middle of an edge stays on it
  }
}

TEST_CASE("shapes: bilinear patches without uv have their own, from 0 to 1 over each") {
  const Scene scene =
      Lit("Shape \"bilinearmesh\" \"integer indices\" [0 1 2 3  1 4 3 5] "
          "\"point3 P\" [0 0 0  1 0 0  0 1 0  1 1 0  2 0 0  2 1 0]");
  REQUIRE(scene.triangle_count() == 4);
  REQUIRE(scene.shapes[0].record.uv_offset != kNone);
  for (size_t i = 0; i < 12; ++i) {
    const uint32_t vertex = scene.indices[i];
    const Point p = RowOf(scene.positions, vertex);
    const float* uv = &scene.uvs[2 * (vertex + scene.shapes[0].record.uv_offset)];
    CHECK(uv[0] == p[0] - (i < 6 ? 0.0 : 1.0));
    CHECK(uv[1] == p[1]);
  }
  const Scene given =
      Lit("Shape \"bilinearmesh\" \"point3 P\" [0 0 0  1 0 0  0 1 0  1 1 1] "
          "\"point2 uv\" [0 0 .5 0 0 .5 .5 .5]");
  float most = 0.0f;
  for (const float value : given.uvs) most = std::max(most, value);
  CHECK(most == 0.5f);
}

}  // namespace swell
