// Hits on instanced primitives in, claims about where they are in the world and where rays start.
#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "src/scene/objects.h"
#include "tests/reference/vector.h"
#include "tests/support/probe.h"
#include "tests/support/scene_builder.h"

namespace swell::test {
namespace {

using reference::Real;
using reference::Vector;

constexpr uint32_t kTriangles = 200, kSpheres = 20, kPlaces = 64;

class Source {
 public:
  explicit Source(uint32_t seed) : engine_(seed) {}
  float Uniform(float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(engine_);
  }
  uint32_t Below(uint32_t count) { return uint32_t(engine_() % count); }
  Vector Direction() {
    std::normal_distribution<double> normal;
    return reference::Normalize({normal(engine_), normal(engine_), normal(engine_)});
  }

 private:
  std::mt19937 engine_;
};

// Turned, stretched by up to `stretch` either way, some mirrored, as far as `away`.
std::array<double, 12> RandomPlace(Source& source, Real stretch, Real away) {
  const Vector z = source.Direction();
  const Vector x = reference::Normalize(reference::Cross(z, source.Direction()));
  const Vector axes[3] = {x, reference::Cross(z, x), z};
  std::array<double, 12> map{};
  for (const Vector& axis : axes) {
    const Real scale = std::pow(stretch, Real(source.Uniform(-1, 1))) *
                       (source.Below(4) == 0 ? Real(-1) : Real(1));
    const Real a[3] = {axis.x, axis.y, axis.z};
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) map[4 * r + c] += double(scale * a[r] * a[c]);
    }
  }
  const Vector turn = source.Direction();  // so that the map is not symmetric: Rodrigues' formula
  std::array<double, 12> turned = map;
  const Real cosine = source.Uniform(-1, 1), sine = std::sqrt(1 - cosine * cosine);
  for (int c = 0; c < 3; ++c) {
    const Vector v{map[c], map[4 + c], map[8 + c]};
    const Vector r = v * cosine + reference::Cross(turn, v) * sine +
                     turn * (reference::Dot(turn, v) * (1 - cosine));
    turned[c] = double(r.x), turned[4 + c] = double(r.y), turned[8 + c] = double(r.z);
  }
  for (int k = 0; k < 3; ++k) turned[4 * k + 3] = double(away) * source.Uniform(-1, 1);
  return turned;
}

// One object of triangles, half of them smooth, and of ellipsoids, and its places.
Scene PlacedScene(Source& source, Real stretch, Real away) {
  SceneBuilder builder;
  for (uint32_t i = 0; i < kTriangles; ++i) {
    const float centre[3] = {source.Uniform(-3, 3), source.Uniform(-3, 3), source.Uniform(-3, 3)};
    std::vector<float> vertices;
    const Vector e1 = source.Direction(), e2 = reference::Cross(e1, source.Direction());
    for (const Vector& corner : {Vector{}, e1, reference::Normalize(e2)}) {
      const Real c[3] = {corner.x, corner.y, corner.z};
      for (int k = 0; k < 3; ++k) vertices.push_back(centre[k] + float(c[k]));
    }
    Shape& shape = builder.AddMesh(vertices, {0, 1, 2});
    shape.record.flags = i % 3 == 0 ? kShapeFlipNormal : 0u;
    if (i % 2 == 0) continue;
    shape.record.normal_offset = uint32_t(builder.scene.normals.size() / 3 - 3 * i);
    for (int v = 0; v < 3; ++v) {
      const Vector n = source.Direction();
      for (Real c : {n.x, n.y, n.z}) builder.scene.normals.push_back(float(c));
    }
  }
  for (uint32_t i = 0; i < kSpheres; ++i) {
    const float x = source.Uniform(-3, 3), y = source.Uniform(-3, 3), z = source.Uniform(-3, 3);
    builder.AddSphere(Ball(source.Uniform(0.5f, 2), x, y, z));
  }
  builder.scene.objects.push_back({"", 0, kTriangles, 0, kSpheres});
  for (uint32_t i = 0; i < kPlaces; ++i) {
    const auto instance = PlaceObject(RandomPlace(source, stretch, away), 0);
    REQUIRE(instance);
    builder.scene.instances.push_back(*instance);
  }
  return builder.scene;
}

Vector Rows(const float* m, const Vector& v) {
  return {m[0] * v.x + m[1] * v.y + m[2] * v.z, m[3] * v.x + m[4] * v.y + m[5] * v.z,
          m[6] * v.x + m[7] * v.y + m[8] * v.z};
}
Vector Centre(const InstanceRecord& i) { return {i.centre[0], i.centre[1], i.centre[2]}; }
Vector NormalToWorld(const InstanceRecord& i, const Vector& n) {
  const float* m = i.to_object;
  return reference::Normalize({m[0] * n.x + m[3] * n.y + m[6] * n.z,
                               m[1] * n.x + m[4] * n.y + m[7] * n.z,
                               m[2] * n.x + m[5] * n.y + m[8] * n.z});
}

// Rays from outside of the object to points of its primitives, in the world. Every fourth row is
// not instanced.
WordColumns RandomHits(Source& source, const Scene& scene, size_t count, bool placed_only) {
  WordColumns in(11, count);
  for (size_t i = 0; i < count; ++i) {
    const uint32_t prim = source.Below(kTriangles + kSpheres);
    const bool placed = placed_only || i % 4 != 0;
    const uint32_t instance = placed ? source.Below(kPlaces) : kNone;
    const float u = source.Uniform(0, 1);
    const float v = (1 - u) * source.Uniform(0, 1);
    Vector p;
    if (prim < kTriangles) {
      const Real weights[3] = {Real(1) - u - v, u, v};
      for (int k = 0; k < 3; ++k) {
        const float* vertex = &scene.positions[3 * size_t{scene.indices[3 * prim + k]}];
        p = p + Vector{vertex[0], vertex[1], vertex[2]} * weights[k];
      }
    } else {
      p = reference::TransformPoint(scene.spheres[prim - kTriangles].object_to_world,
                                    source.Direction());
    }
    if (placed) p = Rows(scene.instances[instance].to_world, p) + Centre(scene.instances[instance]);
    const Vector dir = source.Direction();
    const float t = source.Uniform(0.5f, 5);
    Put(in, 0, i, p - dir * t);
    Put(in, 3, i, dir);
    in.Set(6, i, t);
    in.Word(7, i) = prim;
    in.Set(8, i, prim < kTriangles ? u : 0.0f);
    in.Set(9, i, prim < kTriangles ? v : 0.0f);
    in.Word(10, i) = instance;
  }
  return in;
}

}  // namespace

TEST_CASE("HitSurface: an instance's surface is that of its object, mapped; others are unchanged") {
  Source source(1);
  const Scene scene = PlacedScene(source, 2, 10);
  const SceneTables tables = FinishScene(scene);
  for (size_t count : kRowCounts) {
    const WordColumns in = RandomHits(source, scene, count, false);
    // The same hits in the object's space, not instanced: the reference, tested by surface_test.
    WordColumns flat(10, count);
    for (size_t i = 0; i < count; ++i) {
      for (size_t c = 0; c < 10; ++c) flat.Word(c, i) = in.Word(c, i);
      if (in.Word(10, i) == kNone) continue;
      const InstanceRecord& instance = scene.instances[in.Word(10, i)];
      Put(flat, 0, i, Rows(instance.to_object, At(in, 0, i) - Centre(instance)));
      Put(flat, 3, i, Rows(instance.to_object, At(in, 3, i)));
    }
    ForEachTarget([&](const char* target, Width width) {
      INFO(std::string(target), ", one lane: ", width == Width::kOneLane, ", rows: ", count);
      const WordColumns out = RunProbe(ProbeHitSurface, width, in, 13, &tables.view);
      const WordColumns object = RunProbe(ProbeSurface, width, flat, 13, &tables.view);
      for (size_t i = 0; i < count; ++i) {
        if (in.Word(10, i) == kNone) {
          for (size_t c = 0; c < 13; ++c) REQUIRE(out.Word(c, i) == object.Word(c, i));
          continue;
        }
        const InstanceRecord& instance = scene.instances[in.Word(10, i)];
        const Vector p = Rows(instance.to_world, At(object, 0, i)) + Centre(instance);
        REQUIRE(reference::Length(At(out, 0, i) - p) < 1e-4);
        const Vector n = NormalToWorld(instance, At(object, 6, i));
        const Vector ns = NormalToWorld(instance, At(object, 9, i));
        REQUIRE(reference::Length(At(out, 6, i) - n) < 1e-5);
        REQUIRE(reference::Length(At(out, 9, i) - ns) < 1e-5);
      }
    });
    CheckSameBits(
        [&](Width width) { return RunProbe(ProbeHitSurface, width, in, 13, &tables.view).Rows(); });
  }
}

TEST_CASE(
    "OffsetOrigin: leaves instanced surfaces on the side asked for, as their object sees it") {
  for (const Real stretch : {Real(1), Real(3), Real(100)}) {
    for (const Real away : {Real(0), Real(10), Real(1e4)}) {
      if (stretch * away > 1e5) continue;  // floats there are coarser than objects are thin
      Source source(2);
      const Scene scene = PlacedScene(source, stretch, away);
      const SceneTables tables = FinishScene(scene);
      const size_t count = 4000;
      const WordColumns in = RandomHits(source, scene, count, true);
      ForEachTarget([&](const char* target, Width width) {
        INFO(std::string(target), ", one lane: ", width == Width::kOneLane);
        CAPTURE(double(stretch));
        CAPTURE(double(away));
        const WordColumns out = RunProbe(ProbeHitSurface, width, in, 13, &tables.view);
        WordColumns args(12, count);
        for (size_t i = 0; i < count; ++i) {
          for (size_t c = 0; c < 9; ++c) args.Word(c, i) = out.Word(c, i);
          Put(args, 9, i, source.Direction());
        }
        const WordColumns moved = RunProbe(ProbeOffsetOrigin, width, args, 3);
        for (size_t i = 0; i < count; ++i) {
          const Real cosine = reference::Dot(At(args, 6, i), At(args, 9, i));
          if (std::abs(cosine) < 1e-6) continue;
          const Real side = cosine > 0 ? 1 : -1;
          const InstanceRecord& instance = scene.instances[in.Word(10, i)];
          // As rays are moved to the object, in floats, and exactly.
          float from[3], rounded[3];
          for (int k = 0; k < 3; ++k) from[k] = moved.Float(k, i) - instance.centre[k];
          for (int k = 0; k < 3; ++k) {
            const float* m = instance.to_object + 3 * k;
            rounded[k] = std::fma(m[0], from[0], std::fma(m[1], from[1], m[2] * from[2]));
          }
          const Vector exact = Rows(instance.to_object, At(moved, 0, i) - Centre(instance));
          for (const Vector& p : {exact, Vector{rounded[0], rounded[1], rounded[2]}}) {
            const uint32_t prim = in.Word(7, i);
            if (prim < kTriangles) {
              const auto vertex = [&](uint32_t k) {
                const float* v = &scene.positions[3 * size_t{scene.indices[3 * prim + k]}];
                return Vector{v[0], v[1], v[2]};
              };
              Vector n = reference::Cross(vertex(1) - vertex(0), vertex(2) - vertex(0));
              // The world's normal, pulled back, says which side is outside.
              const Vector outside = reference::Normalize(Rows(instance.to_object, At(args, 6, i)));
              if (reference::Dot(n, outside) < 0) n = n * -1;
              REQUIRE(reference::Dot(n, p - vertex(0)) * side > 0);
            } else {
              const float* m = scene.spheres[prim - kTriangles].world_to_object;
              const Vector unit = reference::TransformPoint(m, p);
              REQUIRE((reference::Length(unit) - 1) * side > 0);
            }
          }
        }
      });
    }
  }
}

}  // namespace swell::test
