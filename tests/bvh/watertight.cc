// Closed meshes in, the rays that slip through their edges out.
#include "tests/bvh/watertight.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

namespace swell::test {
namespace {

constexpr float kPi = 3.14159265f;

void AddFace(Scene& scene, uint32_t a, uint32_t b, uint32_t c) {
  scene.indices.insert(scene.indices.end(), {a, b, c});
}

void AddPoint(Scene& scene, const Float3& p) {
  scene.positions.insert(scene.positions.end(), p.begin(), p.end());
}

// The unit sphere in `rings` rings of `sides` quads; slivers around the poles.
Scene RingSphere(uint32_t rings, uint32_t sides) {
  Scene scene;
  AddPoint(scene, {0, 1, 0});
  for (uint32_t ring = 1; ring < rings; ++ring) {
    const float polar = kPi * static_cast<float>(ring) / static_cast<float>(rings);
    for (uint32_t side = 0; side < sides; ++side) {
      const float azimuth = 2 * kPi * static_cast<float>(side) / static_cast<float>(sides);
      AddPoint(scene, {std::sin(polar) * std::cos(azimuth), std::cos(polar),
                       std::sin(polar) * std::sin(azimuth)});
    }
  }
  const auto last = static_cast<uint32_t>(scene.positions.size() / 3);
  AddPoint(scene, {0, -1, 0});
  for (uint32_t side = 0; side < sides; ++side) {
    const uint32_t next = (side + 1) % sides;
    AddFace(scene, 0, 1 + side, 1 + next);
    for (uint32_t ring = 0; ring + 2 < rings; ++ring) {
      const uint32_t first = 1 + ring * sides;
      AddFace(scene, first + side, first + sides + side, first + sides + next);
      AddFace(scene, first + side, first + sides + next, first + next);
    }
    AddFace(scene, last, last - sides + next, last - sides + side);
  }
  return scene;
}

// Two cones of height 1 over one circle of radius 1.
Scene DoubleCone(uint32_t sides) { return RingSphere(2, sides); }

// The surface of [-1, 1]^3 in squares of side 2 / cells; a power of two makes all coordinates
// exact.
Scene CubeOfSquares(uint32_t cells) {
  Scene scene;
  const uint32_t points = cells + 1;
  for (size_t axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0f, 1.0f}) {
      const auto first = static_cast<uint32_t>(scene.positions.size() / 3);
      for (uint32_t i = 0; i < points * points; ++i) {
        Float3 p;
        p[axis] = side;
        p[(axis + 1) % 3] = 2.0f * static_cast<float>(i % points) / static_cast<float>(cells) - 1;
        p[(axis + 2) % 3] = 2.0f * static_cast<float>(i / points) / static_cast<float>(cells) - 1;
        AddPoint(scene, p);
      }
      for (uint32_t i = 0; i < cells * cells; ++i) {
        const uint32_t v = first + i / cells * points + i % cells;
        AddFace(scene, v, v + 1, v + points + 1);
        AddFace(scene, v, v + points + 1, v + points);
      }
    }
  }
  return scene;
}

Float3 PointInBall(Random& random, float radius) {
  while (true) {
    const Float3 p = random.Point(-1, 1);
    if (p[0] * p[0] + p[1] * p[1] + p[2] * p[2] > 1) continue;
    return {radius * p[0], radius * p[1], radius * p[2]};
  }
}

Float3 Vertex(const Scene& scene, uint32_t index) {
  const float* p = &scene.positions[3 * size_t{index}];
  return {p[0], p[1], p[2]};
}

// A vertex, the middle of an edge, or a point anywhere on it.
Float3 PointOnEdge(const Scene& scene, Random& random) {
  const size_t corner = random.Bits() % scene.indices.size();
  const size_t next = corner % 3 == 2 ? corner - 2 : corner + 1;
  const Float3 a = Vertex(scene, scene.indices[corner]), b = Vertex(scene, scene.indices[next]);
  const uint32_t kind = random.Bits() % 4;
  const float s = kind == 0 ? 0.0f : kind == 1 ? 0.5f : random.Uniform();
  Float3 p;
  for (size_t k = 0; k < 3; ++k) p[k] = a[k] + s * (b[k] - a[k]);
  return p;
}

// Where the inside end lies: anywhere near the centre, at it, or beside `p` along an axis.
Float3 PointInside(const ClosedSurface& surface, const Float3& p, Random& random) {
  const Float3& centre = surface.centre;
  const uint32_t kind = random.Bits() % 8;
  if (kind == 0) return centre;
  if (kind == 1) {
    // The foot of an axis-parallel ray through p, if that is inside.
    const size_t axis = random.Bits() % 3, x = (axis + 1) % 3, y = (axis + 2) % 3;
    Float3 foot = p;
    foot[axis] = centre[axis];
    if (std::hypot(p[x] - centre[x], p[y] - centre[y]) < surface.inner) return foot;
  }
  const Float3 offset = PointInBall(random, surface.inner);
  return {centre[0] + offset[0], centre[1] + offset[1], centre[2] + offset[2]};
}

}  // namespace

std::vector<ClosedSurface> ClosedSurfaces(uint32_t detail) {
  const uint32_t levels = detail == 1 ? 4 : 6;
  const Float3 origin = {0, 0, 0};
  std::vector<ClosedSurface> surfaces;
  // The inner radii are below the distance of the nearest triangle from the centre.
  surfaces.push_back({"rings", RingSphere(16 * detail, 64 * detail), origin, 0.9f, 1.01f});
  surfaces.push_back({"slivers", DoubleCone(600 * detail), origin, 0.7f, 1.01f});
  const Float3 far_away = {4096, -512, 100};
  surfaces.push_back({"far away", ClosedMesh(levels, 1, far_away, 90), far_away, 0.6f, 1.01f});
  surfaces.push_back({"huge", ClosedMesh(levels, 1e12f, origin, 91), origin, 0.6e12f, 1.01e12f});
  surfaces.push_back({"tiny", ClosedMesh(levels, 1e-12f, origin, 92), origin, 0.6e-12f, 1.01e-12f});
  surfaces.push_back({"cube", CubeOfSquares(8 * detail), origin, 0.99f, 1.75f});
  return surfaces;
}

SurfaceRays RaysThroughEdges(const ClosedSurface& surface, size_t count, uint32_t seed) {
  Random random(seed);
  SurfaceRays result;
  for (size_t i = 0; i < count; ++i) {
    const Float3 p = PointOnEdge(surface.scene, random);
    const Float3 inside = PointInside(surface, p, random);
    Ray ray;
    const bool from_inside = random.Bits() % 2 == 0;
    // From outside: beyond p by at least the diameter.
    const float distance = std::hypot(p[0] - inside[0], p[1] - inside[1], p[2] - inside[2]);
    const float factor = 1.0f + 2 * surface.outer / distance * random.Uniform(1, 2);
    for (size_t k = 0; k < 3; ++k) {
      const float to_p = p[k] - inside[k];
      ray.org[k] = from_inside ? inside[k] : inside[k] + factor * to_p;
      ray.dir[k] = from_inside ? to_p : inside[k] - ray.org[k];
    }
    result.rays.push_back(ray);
    result.t_max.push_back(from_inside ? std::numeric_limits<float>::infinity() : 1.0f);
  }
  return result;
}

void Slips::Add(const Slips& other) {
  rays += other.rays;
  slipped += other.slipped;
  if (example.empty()) example = other.example;
}

Slips CountSlips(const ClosedSurface& surface, const Bvh& bvh, Width width, const SurfaceRays& rays,
                 std::span<const NamedTraversal> traversals) {
  const RayTable table(rays.rays);
  std::vector<const char*> slipped(table.count, nullptr);  // the first traversal it slips through
  for (const NamedTraversal& named : traversals) {
    const auto hits = Intersect(bvh, width, named.traversal, table);
    const auto occluded = Occluded(bvh, width, named.traversal, table, rays.t_max);
    for (size_t i = 0; i < table.count; ++i) {
      const bool hit = hits[i].prim != kNoPrim && hits[i].t < rays.t_max[i];
      if ((!hit || !occluded[i]) && slipped[i] == nullptr) slipped[i] = named.name;
    }
  }
  Slips slips;
  slips.rays = table.count;
  for (size_t i = 0; i < table.count; ++i) {
    if (slipped[i] == nullptr) continue;
    if (slips.slipped++ > 0) continue;
    char text[256];
    const Float3 &org = rays.rays[i].org, &dir = rays.rays[i].dir;
    std::snprintf(text, sizeof(text), "%s, %s: from (%a, %a, %a) along (%a, %a, %a)",
                  surface.name.c_str(), slipped[i], double{org[0]}, double{org[1]}, double{org[2]},
                  double{dir[0]}, double{dir[1]}, double{dir[2]});
    slips.example = text;
  }
  return slips;
}

}  // namespace swell::test
