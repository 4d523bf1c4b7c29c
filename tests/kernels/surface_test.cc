// Hits on triangles and spheres in, claims about points, normals and moved origins out.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "tests/reference/vector.h"
#include "tests/support/probe.h"
#include "tests/support/scene_builder.h"

namespace swell::test {
namespace {

using reference::Real;
using reference::Vector;

Vector RandomDirection(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return reference::Normalize({normal(random), normal(random), normal(random)});
}
Vector Vertex(const Scene& scene, uint32_t index) {
  const float* p = &scene.positions[3 * size_t{index}];
  return {p[0], p[1], p[2]};
}
// n, of float length, is within an angle of `tolerance` of the direction of v.
bool Near(const Vector& a, const Vector& b, Real tolerance) {
  return reference::Length(a - b) <= tolerance;
}

// Meshes of random triangles with each combination of flags, with and without normals, and spheres
// under random affine maps.
Scene MixedScene() {
  SceneBuilder builder;
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(-1, 1);
  for (uint32_t flags :
       {0u, kShapeFlipNormal, kShapeNormalsOrient, kShapeFlipNormal | kShapeNormalsOrient}) {
    for (bool smooth : {false, true}) {
      std::vector<float> vertices(3 * 30);
      for (float& v : vertices) v = 5 * uniform(random);
      std::vector<uint32_t> indices;
      for (uint32_t i = 0; i < 3 * 20; ++i) indices.push_back((i * 7 + i / 3) % 30);
      const uint32_t base = uint32_t(builder.scene.positions.size() / 3);
      Shape& shape = builder.AddMesh(vertices, indices);
      shape.record.flags = flags;
      if (!smooth) continue;
      shape.record.normal_offset = uint32_t(builder.scene.normals.size() / 3) - base;
      const size_t first = builder.scene.normals.size();
      for (int i = 0; i < 30; ++i) {
        const Vector n = RandomDirection(random);
        for (Real c : {n.x, n.y, n.z}) builder.scene.normals.push_back(float(c));
      }
      for (size_t i = first; i < first + 3; ++i)
        builder.scene.normals[i] = 0.0f;  // one of no length
    }
  }
  for (int i = 0; i < 20; ++i) {
    Affine map;
    for (float& m : map) m = 3 * uniform(random);
    for (int k = 0; k < 3; ++k) map[5 * k] += 5;
    builder.AddSphere(map).record.flags |= i % 2 != 0 ? kShapeFlipNormal : 0u;
  }
  return builder.scene;
}

struct ExpectedSurface {
  Vector p, n, ns;
  Real area_scale = 1;
};

ExpectedSurface ExpectTriangle(const Scene& scene, uint32_t prim, Real u, Real v) {
  const ShapeRecord& shape = scene.shapes[scene.prim_shape[prim]].record;
  const uint32_t* index = &scene.indices[3 * size_t{prim}];
  const Vector p0 = Vertex(scene, index[0]), p1 = Vertex(scene, index[1]),
               p2 = Vertex(scene, index[2]);
  ExpectedSurface s;
  s.p = p0 * (1 - u - v) + p1 * u + p2 * v;
  s.n = reference::Normalize(reference::Cross(p1 - p0, p2 - p0));
  if ((shape.flags & kShapeFlipNormal) != 0) s.n = s.n * -1;
  s.ns = s.n;
  if (shape.normal_offset == kNone) return s;
  const Real weights[3] = {1 - u - v, u, v};
  Vector sum;
  for (int k = 0; k < 3; ++k) {
    const float* n = &scene.normals[3 * size_t{index[k] + shape.normal_offset}];
    sum = sum + Vector{n[0], n[1], n[2]} * weights[k];
  }
  if (reference::Length(sum) == 0) return s;
  s.ns = reference::Normalize(sum);
  if ((shape.flags & kShapeNormalsOrient) != 0 && reference::Dot(s.n, s.ns) < 0) s.n = s.n * -1;
  return s;
}

// The surface where the direction `object` of the sphere's own space meets it.
ExpectedSurface ExpectSphere(const Scene& scene, uint32_t prim, const Vector& object) {
  const ShapeRecord& shape = scene.shapes[scene.prim_shape[prim]].record;
  const SphereRecord& sphere = scene.spheres[shape.sphere];
  const float* m = sphere.object_to_world;
  ExpectedSurface s;
  s.p = reference::TransformPoint(m, object);
  s.n = reference::TransformNormal(sphere.world_to_object, object);
  const Vector x{m[0], m[4], m[8]}, y{m[1], m[5], m[9]}, z{m[2], m[6], m[10]};
  s.area_scale = std::abs(reference::Dot(x, reference::Cross(y, z))) * reference::Length(s.n);
  s.n = reference::Normalize(s.n);
  if ((shape.flags & kShapeFlipNormal) != 0) s.n = s.n * -1;
  s.ns = s.n;
  return s;
}

// The longest edge D of a triangle, and D^2 over twice its area: 1 or more, large for needles.
struct Needle {
  Real size, aspect;
};
Needle MeasureNeedle(const Scene& scene, uint32_t prim) {
  const uint32_t* corner = &scene.indices[3 * size_t{prim}];
  const Vector a = Vertex(scene, corner[0]), b = Vertex(scene, corner[1]),
               c = Vertex(scene, corner[2]);
  const Real size = std::max(reference::Length(b - a),
                             std::max(reference::Length(c - a), reference::Length(c - b)));
  return {size, std::max(Real(1), size * size / reference::Length(reference::Cross(b - a, c - a)))};
}

TEST_CASE(
    "MakeSurface: points, normals and area equal the reference, triangles or spheres or both") {
  const Scene scene = MixedScene();
  const SceneTables tables = FinishScene(scene);
  const uint32_t triangles = tables.view.triangle_count, prims = uint32_t(scene.prim_shape.size());
  const struct {
    uint32_t first, count;
  } kinds[] = {{0, triangles}, {triangles, prims - triangles}, {0, prims}};
  std::mt19937 random(2);
  std::uniform_real_distribution<float> uniform(0, 1);
  for (const auto& kind : kinds) {
    for (size_t count : kRowCounts) {
      WordColumns in(10, count);
      std::vector<ExpectedSurface> expected;
      for (size_t i = 0; i < count; ++i) {
        const uint32_t prim = kind.first + uint32_t(random() % kind.count);
        const bool first_vertex = i % 5 == 0;  // of which the normal may have no length
        const float u = first_vertex ? 0.0f : uniform(random),
                    v = first_vertex ? 0.0f : (1 - u) * uniform(random);
        in.Word(7, i) = prim;
        in.Set(8, i, prim < triangles ? u : 0.0f);
        in.Set(9, i, prim < triangles ? v : 0.0f);
        const Vector dir = RandomDirection(random);
        const Real t = 10 * uniform(random);
        const Vector object = RandomDirection(random);
        expected.push_back(prim < triangles ? ExpectTriangle(scene, prim, u, v)
                                            : ExpectSphere(scene, prim, object));
        Put(in, 0, i, expected.back().p - dir * t);
        Put(in, 3, i, dir);
        in.Set(6, i, float(t));
      }
      ForEachTarget([&](const char* target, Width width) {
        INFO(std::string(target), ", one lane: ", width == Width::kOneLane, ", rows: ", count);
        const WordColumns out = RunProbe(ProbeSurface, width, in, 13, &tables.view);
        for (size_t i = 0; i < count; ++i) {
          const ExpectedSurface& s = expected[i];
          CAPTURE(in.Word(7, i));
          // Points near an edge are moved inside by their rounding; needles have wide bounds.
          const uint32_t prim = in.Word(7, i);
          const Needle needle = prim < triangles ? MeasureNeedle(scene, prim) : Needle{0, 1};
          const Real moved = 1e-6 * (reference::Length(s.p) + 2 * needle.size) * needle.aspect;
          REQUIRE(Near(At(out, 0, i), s.p, prim < triangles ? 3e-5 + 2 * moved : 3e-5));
          const Vector error = At(out, 3, i);
          REQUIRE((error.x > 0 && error.y > 0 && error.z > 0));
          REQUIRE(reference::Length(error) < 5e-5 + 1e-6 * needle.size * needle.aspect);
          REQUIRE(Near(At(out, 6, i), s.n, 5e-5));
          REQUIRE(Near(At(out, 9, i), s.ns, 5e-5));
          REQUIRE(std::abs(out.Float(12, i) / s.area_scale - 1) < 2e-5);
        }
      });
      CheckSameBits(
          [&](Width width) { return RunProbe(ProbeSurface, width, in, 13, &tables.view).Rows(); });
    }
  }
}

TEST_CASE("MakeSurface: the plane of the triangle passes through the box of the error") {
  const Scene scene = MixedScene();
  const SceneTables tables = FinishScene(scene);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(0, 1);
  WordColumns in(10, 20000);
  for (size_t i = 0; i < in.count(); ++i) {
    const float u = uniform(random);
    for (size_t c = 0; c < 7; ++c) in.Set(c, i, 1.0f);
    in.Word(7, i) = uint32_t(random() % tables.view.triangle_count);
    in.Set(8, i, u);
    in.Set(9, i, (1 - u) * uniform(random));
  }
  ForEachTarget([&](const char* target, Width width) {
    INFO(std::string(target), ", one lane: ", width == Width::kOneLane);
    const WordColumns out = RunProbe(ProbeSurface, width, in, 13, &tables.view);
    for (size_t i = 0; i < in.count(); ++i) {
      const ExpectedSurface s =
          ExpectTriangle(scene, in.Word(7, i), in.Float(8, i), in.Float(9, i));
      const Vector off = At(out, 0, i) - s.p, error = At(out, 3, i);
      const Vector n{std::abs(s.n.x), std::abs(s.n.y), std::abs(s.n.z)};
      REQUIRE(std::abs(reference::Dot(s.n, off)) <= reference::Dot(n, error));
    }
  });
}

// Surfaces at random places of all primitives, with random directions to leave by.
struct Leaving {
  WordColumns hits, surfaces, args, moved;
  Leaving(const SceneView& view, size_t count, Width width, const std::vector<Vector>& centres)
      : hits(10, count), surfaces(13, count), args(12, count), moved(3, count) {
    std::mt19937 random(4);
    std::uniform_real_distribution<float> uniform(0, 1);
    for (size_t i = 0; i < count; ++i) {
      const uint32_t prims = view.triangle_count + view.sphere_count;
      const uint32_t prim = uint32_t(random() % prims);
      const float u = uniform(random);
      // A hit point somewhere around the sphere is put onto it.
      const Vector centre = centres.empty() ? Vector{} : centres[prim - view.triangle_count];
      const Real size = prim < view.triangle_count
                            ? 1
                            : view.spheres[prim - view.triangle_count].object_to_world[0];
      Put(hits, 0, i, centre + RandomDirection(random) * size);
      Put(hits, 3, i, {0, 0, 1});
      hits.Set(6, i, 0.0f);
      hits.Word(7, i) = prim;
      hits.Set(8, i, u);
      hits.Set(9, i, (1 - u) * uniform(random));
    }
    surfaces = RunProbe(ProbeSurface, width, hits, 13, &view);
    for (size_t i = 0; i < count; ++i) {
      for (size_t c = 0; c < 9; ++c) args.Word(c, i) = surfaces.Word(c, i);
      Put(args, 9, i, RandomDirection(random));
    }
    moved = RunProbe(ProbeOffsetOrigin, width, args, 3);
  }
  // +1 or -1: the side of the surface's normal to which row i leaves; 0 along the surface.
  int Side(size_t i) const {
    const Real cosine = reference::Dot(At(args, 6, i), At(args, 9, i));
    return std::abs(cosine) < 1e-6 ? 0 : cosine > 0 ? 1 : -1;
  }
};

TEST_CASE("OffsetOrigin: leaves a triangle strictly on the side asked for, at scales 1e-6 to 1e6") {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> uniform(-1, 1);
  for (float scale : {1e-6f, 1e-3f, 1.0f, 1e3f, 1e6f}) {
    for (float distance : {0.0f, 1.0f, 100.0f}) {  // of the triangles from the origin, in sizes
      SceneBuilder builder;
      for (int k = 0; k < 200; ++k) {
        std::vector<float> vertices(9);
        for (int i = 0; i < 9; ++i)
          vertices[i] = scale * (uniform(random) + distance * float(i % 3 + 1));
        builder.AddMesh(vertices, {0, 1, 2});
      }
      const SceneTables tables = FinishScene(builder.scene);
      ForEachTarget([&](const char* target, Width width) {
        INFO(std::string(target), ", one lane: ", width == Width::kOneLane);
        CAPTURE(scale);
        CAPTURE(distance);
        const Leaving leaving(tables.view, 5000, width, {});
        for (size_t i = 0; i < 5000; ++i) {
          const uint32_t prim = leaving.hits.Word(7, i);
          const Vector p0 = Vertex(builder.scene, 3 * prim),
                       p1 = Vertex(builder.scene, 3 * prim + 1),
                       p2 = Vertex(builder.scene, 3 * prim + 2);
          const Vector n = reference::Cross(p1 - p0, p2 - p0);
          if (reference::Length(n) < 0.02 * reference::Length(p1 - p0) * reference::Length(p2 - p0))
            continue;
          const Vector moved = At(leaving.moved, 0, i);
          if (leaving.Side(i) != 0) REQUIRE(reference::Dot(n, moved - p0) * leaving.Side(i) > 0);
          // Not further than rounding needs, of the point and of a test that meets needles.
          const Needle needle = MeasureNeedle(builder.scene, prim);
          const Real test = 8 * 0x1p-24 * needle.size * needle.aspect;
          REQUIRE(reference::Length(moved - At(leaving.surfaces, 0, i)) <
                  4e-6 * scale * (3 * distance + 1) + 2 * test);
        }
      });
    }
  }
}

TEST_CASE(
    "OffsetOrigin: leaves planes through zero, where rounding is exact, by more than nothing") {
  for (int axis = 0; axis < 3; ++axis) {
    SceneBuilder builder;
    for (int k = 0; k < 2; ++k) {  // around the origin, and with a vertex in it
      std::vector<float> vertices{-1, -1, 3, -2, 0.5f, 4};
      if (k == 1) vertices = {0, 0, 3, -2, 0.5f, 4};
      std::vector<float> in_plane;
      for (int v = 0; v < 3; ++v) {
        for (int i = 0; i < 3; ++i) {
          in_plane.push_back(i == axis ? 0.0f : vertices[2 * v + ((i - axis + 3) % 3 - 1)]);
        }
      }
      builder.AddMesh(in_plane, {0, 1, 2});
    }
    const SceneTables tables = FinishScene(builder.scene);
    ForEachTarget([&](const char* target, Width width) {
      INFO(std::string(target), ", one lane: ", width == Width::kOneLane, ", axis: ", axis);
      const Leaving leaving(tables.view, 1000, width, {});
      for (size_t i = 0; i < 1000; ++i) {
        const Vector moved = At(leaving.moved, 0, i), n = At(leaving.args, 6, i);
        // As far as the last digit of the point's largest coordinate.
        const Real size = reference::Length(At(leaving.surfaces, 0, i));
        if (leaving.Side(i) == 0) continue;
        REQUIRE(reference::Dot(n, moved) * leaving.Side(i) > 0x1p-25 * size);
        REQUIRE(reference::Dot(n, moved) * leaving.Side(i) < 1e-5);
      }
    });
  }
}

TEST_CASE("OffsetOrigin: leaves spheres of radius 1e-3 and 1e6 on the side asked for") {
  const struct {
    float radius, x, y, z;
  } balls[] = {{1e-3f, 0, 0, 0},    {1e-3f, 1, -2, 0.5f},   {1e6f, 0, 0, 0},
               {1e6f, 0, -1e6f, 0}, {1e6f, 3e5f, 7, -2e6f}, {1, 0.1f, 0.2f, 0.3f}};
  for (const auto& ball : balls) {
    SceneBuilder builder;
    builder.AddSphere(Ball(ball.radius, ball.x, ball.y, ball.z));
    const SceneTables tables = FinishScene(builder.scene);
    const Vector centre{ball.x, ball.y, ball.z};
    ForEachTarget([&](const char* target, Width width) {
      INFO(std::string(target), ", one lane: ", width == Width::kOneLane,
           ", radius: ", ball.radius);
      const Leaving leaving(tables.view, 20000, width, {centre});
      for (size_t i = 0; i < 20000; ++i) {
        const Vector from_centre = At(leaving.moved, 0, i) - centre;
        const Real beyond =
            reference::Dot(from_centre, from_centre) - Real{ball.radius} * ball.radius;
        if (leaving.Side(i) != 0) REQUIRE(beyond * leaving.Side(i) > 0);
      }
    });
  }
}

TEST_CASE("NextFloat: is std::nextafter for every kind of float") {
  std::mt19937 random(6);
  WordColumns in(2, 20000);
  const uint32_t special[] = {0x00000000u, 0x80000000u, 0x00000001u, 0x80000001u,
                              0x007FFFFFu, 0x00800000u, 0x807FFFFFu, 0x80800000u,
                              0x7F7FFFFFu, 0xFF7FFFFFu, 0x3F800000u, 0xBF800000u};
  for (size_t i = 0; i < in.count(); ++i) {
    uint32_t bits = i < 2 * std::size(special) ? special[i / 2] : uint32_t(random());
    if ((bits & 0x7F800000u) == 0x7F800000u) bits ^= 0x40000000u;
    in.Word(0, i) = bits;
    in.Word(1, i) = i % 2;
  }
  ForEachTarget([&](const char* target, Width width) {
    INFO(std::string(target), ", one lane: ", width == Width::kOneLane);
    const WordColumns out = RunProbe(ProbeNextFloat, width, in, 1);
    for (size_t i = 0; i < in.count(); ++i) {
      const float infinity = in.Word(1, i) != 0 ? INFINITY : -INFINITY;
      REQUIRE(out.Float(0, i) == std::nextafter(in.Float(0, i), infinity));
    }
  });
}

TEST_CASE("MakeFrame: is orthonormal and right-handed, and vectors come back from local space") {
  std::mt19937 random(7);
  for (size_t count : kRowCounts) {
    WordColumns in(6, count);
    for (size_t i = 0; i < count; ++i) {
      Vector z = RandomDirection(random);
      if (i < 6) z = {i / 2 == 0 ? 1.0L : 0, i / 2 == 1 ? 1.0L : 0, i / 2 == 2 ? 1.0L : 0};
      if (i < 6 && i % 2 != 0) z = z * -1;
      if (i == 6) z = reference::Normalize({1e-4L, -1e-4L, -1});
      Put(in, 0, i, z);
      Put(in, 3, i, RandomDirection(random));
    }
    ForEachTarget([&](const char* target, Width width) {
      INFO(std::string(target), ", one lane: ", width == Width::kOneLane, ", rows: ", count);
      const WordColumns out = RunProbe(ProbeFrame, width, in, 12);
      for (size_t i = 0; i < count; ++i) {
        const Vector x = At(out, 0, i), y = At(out, 3, i), z = At(in, 0, i), v = At(in, 3, i);
        REQUIRE(std::abs(reference::Length(x) - 1) < 1e-6);
        REQUIRE(std::abs(reference::Length(y) - 1) < 1e-6);
        REQUIRE(std::abs(reference::Dot(x, y)) < 1e-6);
        REQUIRE(std::abs(reference::Dot(x, z)) < 1e-6);
        REQUIRE(std::abs(reference::Dot(y, z)) < 1e-6);
        REQUIRE(Near(reference::Cross(x, y), z, 1e-6));
        REQUIRE(Near(At(out, 6, i),
                     {reference::Dot(x, v), reference::Dot(y, v), reference::Dot(z, v)}, 1e-6));
        REQUIRE(Near(At(out, 9, i), v, 1e-6));
      }
    });
    CheckSameBits([&](Width width) { return RunProbe(ProbeFrame, width, in, 12).Rows(); });
  }
}

}  // namespace
}  // namespace swell::test
