// Points of triangles and spheres in, claims about the frames along u out.
#include <doctest/doctest.h>

#include <cmath>

#include "src/scene/objects.h"
#include "tests/support/probe.h"
#include "tests/support/scene_builder.h"

namespace swell::test {
namespace {

using reference::Vector;

bool Near(const Vector& a, const Vector& b) { return reference::Length(a - b) < 1e-5; }

// A right triangle without uvs, one whose u runs along y, one whose uvs are one point, and a
// stretched ball.
Scene FourShapes() {
  SceneBuilder builder;
  const std::vector<float> corner = {0, 0, 0, 2, 0, 0, 0, 3, 0};
  for (int i = 0; i < 3; ++i) {
    const uint32_t base = uint32_t(builder.scene.positions.size() / 3);
    Shape& shape = builder.AddMesh(corner, {0, 1, 2});
    if (i == 0) continue;
    shape.record.uv_offset = uint32_t(builder.scene.uvs.size() / 2) - base;
    const std::vector<float> uvs =
        i == 1 ? std::vector<float>{0, 0, 0, 1, 1, 0} : std::vector<float>{1, 1, 1, 1, 1, 1};
    builder.scene.uvs.insert(builder.scene.uvs.end(), uvs.begin(), uvs.end());
  }
  builder.AddSphere({2, 0, 0, 5, 0, 1, 0, 0, 0, 0, 1, 0});
  return builder.scene;
}

TEST_CASE("MakeFrameAlong: x is dp/du in the surface, on triangles and spheres") {
  const Scene scene = FourShapes();
  const SceneTables tables = FinishScene(scene);
  const double half = std::sqrt(0.5);
  struct Row {
    uint32_t prim;
    Vector p, n, x;
  };
  const Row rows[] = {
      {0, {0.1, 0.1, 0}, {0, 0, 1}, {1, 0, 0}},               // along the first edge
      {0, {0.1, 0.1, 0}, {half, 0, half}, {half, 0, -half}},  // the part of it in the surface
      {1, {0.1, 0.1, 0}, {0, 0, 1}, {0, 1, 0}},
      {1, {0.1, 0.1, 0}, {0, 0, -1}, {0, 1, 0}},
      {3, {7, 0, 0}, {1, 0, 0}, {0, 1, 0}},   // where the object's x axis comes out
      {3, {5, 1, 0}, {0, 1, 0}, {-1, 0, 0}},  // and its y axis
  };
  for (size_t count : kRowCounts) {
    WordColumns in(10, count);
    for (size_t i = 0; i < count; ++i) {
      const Row& row = rows[i % std::size(rows)];
      in.Word(7, i) = kNone;
      Put(in, 0, i, row.p);
      in.Word(3, i) = row.prim;
      Put(in, 4, i, row.n);
    }
    ForEachTarget([&](const char* target, Width width) {
      INFO(std::string(target), ", one lane: ", width == Width::kOneLane, ", rows: ", count);
      const WordColumns out = RunProbe(ProbeTangent, width, in, 10, &tables.view);
      for (size_t i = 0; i < count; ++i) {
        const Row& row = rows[i % std::size(rows)];
        REQUIRE(Near(At(out, 0, i), row.x));
        REQUIRE(Near(At(out, 3, i), reference::Cross(row.n, row.x)));
        REQUIRE(Near(At(out, 6, i), row.n));
      }
    });
    CheckSameBits(
        [&](Width width) { return RunProbe(ProbeTangent, width, in, 10, &tables.view).Rows(); });
  }
}

TEST_CASE("MakeFrameAlong: where u says nothing the frame is still orthonormal") {
  const Scene scene = FourShapes();
  const SceneTables tables = FinishScene(scene);
  WordColumns in(10, 3);
  const Vector normals[] = {{0, 0, 1}, {1, 0, 0}, {0, 0, 1}};
  const Vector points[] = {{0.1, 0.1, 0}, {0.1, 0.1, 0}, {5, 0, 1}};  // the last one a pole
  const uint32_t prims[] = {2, 0, 3};                                 // u along n in the middle
  for (size_t i = 0; i < 3; ++i) {
    Put(in, 0, i, points[i]);
    in.Word(3, i) = prims[i];
    in.Word(7, i) = kNone;
    Put(in, 4, i, normals[i]);
  }
  ForEachTarget([&](const char* target, Width width) {
    INFO(std::string(target), ", one lane: ", width == Width::kOneLane);
    const WordColumns out = RunProbe(ProbeTangent, width, in, 10, &tables.view);
    for (size_t i = 0; i < 3; ++i) {
      const Vector x = At(out, 0, i), y = At(out, 3, i);
      CHECK(reference::Length(x) == doctest::Approx(1).epsilon(1e-5));
      CHECK(std::fabs(reference::Dot(x, normals[i])) < 1e-6);
      CHECK(Near(y, reference::Cross(normals[i], x)));
    }
  });
}

TEST_CASE("HitTangent: the vertices' tangents replace dp/du where a mesh has them") {
  Scene scene = FourShapes();
  // The second triangle, whose u runs along y: along x at its first vertex, along z at the others.
  scene.shapes[1].tangent_offset = static_cast<uint32_t>(0 - scene.indices[3]);
  scene.tangents = {1, 0, 0, -1, 0, 0, 1, -1, 0, 0, 1, -1};
  // The object's x axis points to -x in the world.
  scene.instances = {*PlaceObject({-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}, 0)};
  const SceneTables tables = FinishScene(scene);
  struct Row {
    uint32_t prim, instance;
    float b1;
    Vector x;
    float side;
  };
  const double half = std::sqrt(0.5);
  const Row rows[] = {
      {1, kNone, 0.0f, {1, 0, 0}, -1},        // at the first vertex
      {1, kNone, 0.5f, {half, 0, half}, -1},  // between two
      {1, 0, 0.0f, {-1, 0, 0}, 1},            // in a mirror
      {0, kNone, 0.0f, {1, 0, 0}, 1},         // a mesh without: dp/du, dp/dv
      {3, kNone, 0.0f, {-1, 0, 0}, 1},        // the ball's y axis
  };
  WordColumns in(10, std::size(rows));
  for (size_t i = 0; i < std::size(rows); ++i) {
    Put(in, 0, i, rows[i].prim == 3 ? Vector{5, 1, 0} : Vector{0.1, 0.1, 0});
    in.Word(3, i) = rows[i].prim;
    Put(in, 4, i, rows[i].prim == 0 ? Vector{0, 0, 1} : Vector{0, 1, 0});
    in.Word(7, i) = rows[i].instance;
    in.Set(8, i, rows[i].b1);
    in.Set(9, i, 0.0f);
  }
  ForEachTarget([&](const char* target, Width width) {
    INFO(std::string(target), ", one lane: ", width == Width::kOneLane);
    const WordColumns out = RunProbe(ProbeTangent, width, in, 10, &tables.view);
    for (size_t i = 0; i < std::size(rows); ++i) {
      INFO("row ", i);
      CHECK(Near(At(out, 0, i), rows[i].x));
      CHECK(out.Float(9, i) == rows[i].side);
    }
  });
}

TEST_CASE("FinishScene: scenes without tangents or second coordinates have no columns of them") {
  const Scene scene = FourShapes();
  const SceneTables tables = FinishScene(scene);
  CHECK(tables.view.tangent_offsets == nullptr);
  CHECK(tables.view.second_uv_offsets == nullptr);
}

}  // namespace
}  // namespace swell::test
