// Shapes: vertices, normals, orientation and order of primitives in world space.
#include <array>
#include <cmath>

#include "tests/import/scene_texts.h"

namespace swell {
namespace {

constexpr double kPi = 3.14159265358979;
using Vec = std::array<double, 3>;

Scene Lit(const std::string& text) { return test::WorldOf("LightSource \"infinite\"\n" + text); }

Vec RowOf(const std::vector<float>& values, size_t row) {
  return {values[3 * row], values[3 * row + 1], values[3 * row + 2]};
}
Vec Minus(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vec Cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double Dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// The geometric normal of a triangle as the kernels take it, not normalised: twice its area long.
Vec NormalOf(const Scene& scene, size_t triangle) {
  const uint32_t* v = &scene.indices[3 * triangle];
  const ShapeRecord& shape = scene.shapes[scene.prim_shape[triangle]].record;
  const Vec a = RowOf(scene.positions, v[0]);
  Vec n = Cross(Minus(RowOf(scene.positions, v[1]), a), Minus(RowOf(scene.positions, v[2]), a));
  bool flip = (shape.flags & kShapeFlipNormal) != 0;
  if ((shape.flags & kShapeNormalsOrient) != 0) {
    flip = Dot(n, RowOf(scene.normals, v[0] + shape.normal_offset)) < 0.0;
  }
  return flip ? Vec{-n[0], -n[1], -n[2]} : n;
}

double AreaOf(const Scene& scene) {
  double area = 0.0;
  for (size_t i = 0; i < scene.triangle_count(); ++i) {
    const Vec n = NormalOf(scene, i);
    area += 0.5 * std::sqrt(Dot(n, n));
  }
  return area;
}

constexpr const char* kTriangle = "Shape \"trianglemesh\" \"point3 P\" [0 0 0  1 0 0  0 1 0] ";

double NormalZ(const std::string& text) {
  const Scene scene = Lit(text);
  REQUIRE(scene.triangle_count() >= 1);
  return NormalOf(scene, 0)[2];
}

}  // namespace

TEST_CASE("shapes: a triangle's normal is e1 x e2, turned by ReverseOrientation only") {
  CHECK(NormalZ(kTriangle) > 0);
  CHECK(NormalZ(std::string("ReverseOrientation ") + kTriangle) < 0);
  CHECK(NormalZ(std::string("ReverseOrientation ReverseOrientation ") + kTriangle) > 0);
  CHECK(NormalZ(std::string("Scale -1 1 1 ") + kTriangle) > 0);
  CHECK(NormalZ(std::string("Scale -1 1 1 ReverseOrientation ") + kTriangle) < 0);
  CHECK(NormalZ(std::string("Rotate 180 1 0 0 ") + kTriangle) < 0);
}

TEST_CASE("shapes: normals of a mesh decide its side") {
  const std::string down = std::string(kTriangle) + "\"normal N\" [0 0 -1 0 0 -1 0 0 -1]";
  CHECK(NormalZ(down) < 0);
  CHECK(NormalZ("ReverseOrientation " + down) > 0);
  CHECK(NormalZ("Scale -1 1 1 " + down) < 0);
  CHECK(NormalZ("Scale 1 1 -1 " + down) > 0);
}

TEST_CASE("shapes: normals go to the world by the inverse transpose and are of unit length") {
  const Scene scene =
      Lit(std::string("Scale 2 1 1 ") + kTriangle + "\"normal N\" [3 3 0  0 0 5  0 1 0]");
  REQUIRE(scene.normals.size() == 9);
  CHECK(scene.normals[0] == doctest::Approx(1 / std::sqrt(5.0)));
  CHECK(scene.normals[1] == doctest::Approx(2 / std::sqrt(5.0)));
  CHECK(scene.normals[5] == doctest::Approx(1.0));
  CHECK(scene.shapes[0].record.normal_offset == 0);
}

TEST_CASE("shapes: a zero normal drops the normals of its mesh with a warning") {
  const Scene scene = Lit(std::string(kTriangle) + "\"normal N\" [0 0 1 0 0 0 0 0 1]");
  CHECK(scene.normals.empty());
  CHECK(scene.shapes[0].record.normal_offset == kNone);
  CHECK((scene.shapes[0].record.flags & kShapeNormalsOrient) == 0);
  CHECK(test::Warns(scene, "a normal is zero"));
}

TEST_CASE("shapes: offsets lead from vertices to the rows of normals and uvs") {
  const Scene scene = Lit(
      std::string(kTriangle) +
      "Shape \"trianglemesh\" \"point3 P\" [0 0 1  1 0 1  0 1 1] \"normal N\" [0 0 1 0 1 0 1 0 0] "
      "\"point2 uv\" [0.1 0.2 0.3 0.4 0.5 0.6]");
  const ShapeRecord& record = scene.shapes[1].record;
  CHECK(scene.shapes[0].record.uv_offset == kNone);
  for (uint32_t i = 0; i < 3; ++i) CHECK(scene.indices[3 + i] + record.normal_offset == i);
  CHECK(scene.uvs[2 * (scene.indices[4] + record.uv_offset)] == 0.3f);
}

TEST_CASE("shapes: primitives are all triangles in file order, then all spheres") {
  const Scene scene = Lit(std::string("Shape \"sphere\" ") + kTriangle +
                          "Shape \"sphere\" Shape \"bilinearmesh\" \"point3 P\" "
                          "[0 0 0 1 0 0 0 1 0 1 1 0]");
  REQUIRE(scene.shapes.size() == 4);
  CHECK(scene.triangle_count() == 3);
  CHECK(scene.prim_shape == std::vector<uint32_t>{1, 3, 3, 0, 2});
  const uint32_t first[] = {3, 0, 4, 1}, count[] = {1, 1, 1, 2};
  for (size_t i = 0; i < 4; ++i) {
    CHECK(scene.shapes[i].record.first_prim == first[i]);
    CHECK(scene.shapes[i].record.prim_count == count[i]);
    CHECK(scene.shapes[i].record.first_light == kNone);
  }
  CHECK(scene.shapes[2].record.sphere == 1);
}

TEST_CASE("shapes: a sphere is the unit sphere under its radius and transform") {
  const Scene scene = Lit("Translate 1 2 3 Scale 1 2 -1 Shape \"sphere\" \"float radius\" 0.5");
  REQUIRE(scene.spheres.size() == 1);
  const float* m = scene.spheres[0].object_to_world;
  const float expected[12] = {0.5f, 0, 0, 1, 0, 1, 0, 2, 0, 0, -0.5f, 3};
  for (size_t i = 0; i < 12; ++i) CHECK(m[i] == expected[i]);
  const float* w = scene.spheres[0].world_to_object;
  CHECK(w[0] == 2.0f);
  CHECK(w[3] == -2.0f);
  CHECK(w[11] == 6.0f);
  CHECK(scene.shapes[0].record.flags == kShapeIsSphere);
  CHECK(Lit("ReverseOrientation Shape \"sphere\"").shapes[0].record.flags ==
        (kShapeIsSphere | kShapeFlipNormal));
}

TEST_CASE("shapes: a disk has the circle's area, faces +z and may be a ring or a sector") {
  const Scene full = Lit("Shape \"disk\" \"float radius\" 2 \"float height\" 3");
  CHECK(full.triangle_count() >= 128);
  CHECK(AreaOf(full) == doctest::Approx(kPi * 4).epsilon(1e-6));
  for (size_t i = 0; i < full.triangle_count(); ++i) CHECK(NormalOf(full, i)[2] > 0);
  CHECK(full.positions[2] == 3.0f);
  CHECK(AreaOf(Lit("Shape \"disk\" \"float innerradius\" 0.5")) ==
        doctest::Approx(kPi * 0.75).epsilon(1e-6));
  CHECK(AreaOf(Lit("Shape \"disk\" \"float phimax\" 90")) ==
        doctest::Approx(kPi * 0.25).epsilon(1e-6));
}

TEST_CASE("shapes: a part of a sphere is a fine mesh whose normals point outward") {
  const Scene scene = Lit("Shape \"sphere\" \"float radius\" 2 \"float zmin\" 0");
  CHECK(scene.spheres.empty());
  CHECK(test::Warns(scene, "as triangles"));
  CHECK(AreaOf(scene) == doctest::Approx(2 * kPi * 4).epsilon(1e-3));
  for (size_t i = 0; i < scene.triangle_count(); ++i) {
    CHECK(Dot(NormalOf(scene, i), RowOf(scene.positions, scene.indices[3 * i])) > 0);
  }
  CHECK(AreaOf(Lit("Shape \"sphere\" \"float phimax\" 180")) ==
        doctest::Approx(2 * kPi).epsilon(1e-3));
}

TEST_CASE(
    "shapes: a flat bilinear patch is two triangles, a curved one a grid through its corners") {
  const Scene flat = Lit("Shape \"bilinearmesh\" \"point3 P\" [0 0 0 2 0 0 0 3 0 2 3 0]");
  CHECK(flat.triangle_count() == 2);
  CHECK(AreaOf(flat) == doctest::Approx(6.0));
  CHECK(NormalOf(flat, 0)[2] > 0);
  CHECK(NormalOf(flat, 1)[2] > 0);
  const Scene curved = Lit("Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 1]");
  CHECK(curved.triangle_count() == 512);
  CHECK(test::Warns(curved, "curved patch"));
  // z = x y on every vertex of the grid.
  for (uint32_t index : curved.indices) {
    const Vec p = RowOf(curved.positions, index);
    CHECK(p[2] == doctest::Approx(p[0] * p[1]));
  }
}

TEST_CASE("shapes: triangles without area are dropped and counted once per mesh") {
  const Scene scene =
      Lit("Shape \"trianglemesh\" \"point3 P\" [0 0 0  1 0 0  0 1 0  2 0 0] "
          "\"integer indices\" [0 1 1  0 1 2  0 1 3]");
  CHECK(scene.triangle_count() == 1);
  CHECK(test::Warns(scene, "2 triangles without area are left out"));
  const Scene none = Lit("Shape \"trianglemesh\" \"point3 P\" [0 0 0 0 0 0 0 0 0]");
  CHECK(none.shapes.empty());
  CHECK(test::Warns(none, "has no triangles"));
}

TEST_CASE("shapes: small triangles stay") {
  CHECK(Lit(std::string("Scale 1e-8 1e-8 1e-8 ") + kTriangle).triangle_count() == 1);
}

}  // namespace swell
