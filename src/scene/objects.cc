// A scene and its objects in; which primitives stand in the world itself, where objects are placed,
// and how far everything reaches out.
#include "src/scene/objects.h"

#include <algorithm>
#include <cmath>

namespace swell {
namespace {

template <class FirstOf, class CountOf>
std::vector<RowRange> Unclaimed(const Scene& scene, size_t rows, const FirstOf& first_of,
                                const CountOf& count_of) {
  std::vector<RowRange> ranges;
  size_t next = 0;
  for (const Object& object : scene.objects) {
    if (count_of(object) == 0) continue;
    if (first_of(object) > next) ranges.push_back({next, first_of(object) - next});
    next = size_t{first_of(object)} + count_of(object);
  }
  if (rows > next) ranges.push_back({next, rows - next});
  return ranges;
}

void AddTriangles(const Scene& scene, const RowRange& range, Bounds& bounds) {
  for (size_t i = 3 * range.first; i < 3 * (range.first + range.count); ++i) {
    for (size_t axis = 0; axis < 3; ++axis) {
      const double x = scene.positions[3 * size_t{scene.indices[i]} + axis];
      bounds.Add(axis, x, x);
    }
  }
}

void AddSpheres(const Scene& scene, const RowRange& range, Bounds& bounds) {
  for (size_t i = range.first; i < range.first + range.count; ++i) {
    for (size_t axis = 0; axis < 3; ++axis) {
      // The unit sphere reaches as far along an axis as that row of the map is long.
      const float* row = scene.spheres[i].object_to_world + 4 * axis;
      const double reach =
          std::sqrt(double{row[0]} * row[0] + double{row[1]} * row[1] + double{row[2]} * row[2]);
      bounds.Add(axis, row[3] - reach, row[3] + reach);
    }
  }
}

void AddInstance(const InstanceRecord& instance, const Bounds& object, Bounds& bounds) {
  if (object.empty()) return;
  for (size_t axis = 0; axis < 3; ++axis) {
    double low = instance.centre[axis], high = low;
    for (size_t k = 0; k < 3; ++k) {
      const double m = instance.to_world[3 * axis + k];
      low += std::min(m * object.low[k], m * object.high[k]);
      high += std::max(m * object.low[k], m * object.high[k]);
    }
    bounds.Add(axis, low, high);
  }
}

}  // namespace

std::vector<RowRange> WorldTriangles(const Scene& scene) {
  return Unclaimed(
      scene, scene.triangle_count(), [](const Object& o) { return o.first_triangle; },
      [](const Object& o) { return o.triangle_count; });
}

std::vector<RowRange> WorldSpheres(const Scene& scene) {
  return Unclaimed(
      scene, scene.spheres.size(), [](const Object& o) { return o.first_sphere; },
      [](const Object& o) { return o.sphere_count; });
}

std::optional<InstanceRecord> PlaceObject(const std::array<double, 12>& object_to_world,
                                          uint32_t object) {
  InstanceRecord record{};
  record.object = object;
  double m[3][3];  // what the floats say, so that the two maps are inverse to each other
  double size = 1.0;
  for (size_t r = 0; r < 3; ++r) {
    for (size_t c = 0; c < 3; ++c) {
      record.to_world[3 * r + c] = static_cast<float>(object_to_world[4 * r + c]);
      m[r][c] = record.to_world[3 * r + c];
    }
    record.centre[r] = static_cast<float>(object_to_world[4 * r + 3]);
  }
  for (size_t c = 0; c < 3; ++c) size *= std::hypot(m[0][c], m[1][c], m[2][c]);
  double cofactor[3][3], determinant = 0.0;
  for (size_t r = 0; r < 3; ++r) {
    for (size_t c = 0; c < 3; ++c) {
      const size_t r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
      cofactor[r][c] = m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
    }
  }
  for (size_t c = 0; c < 3; ++c) determinant += m[0][c] * cofactor[0][c];
  constexpr double kSingular = 1e-9;   // against the product of the columns' lengths
  constexpr double kMostScale = 1e15;  // so that floats hold squares
  if (!std::isfinite(size) || !(std::abs(determinant) > kSingular * size)) return std::nullopt;
  for (size_t r = 0; r < 3; ++r) {
    for (size_t c = 0; c < 3; ++c) {
      const double inverse = cofactor[c][r] / determinant;
      if (!(std::abs(m[r][c]) <= kMostScale && std::abs(inverse) <= kMostScale)) {
        return std::nullopt;
      }
      record.to_object[3 * r + c] = static_cast<float>(inverse);
    }
    if (!std::isfinite(record.centre[r])) return std::nullopt;
  }
  return record;
}

Bounds WorldBounds(const Scene& scene) {
  Bounds bounds;
  for (const RowRange& range : WorldTriangles(scene)) AddTriangles(scene, range, bounds);
  for (const RowRange& range : WorldSpheres(scene)) AddSpheres(scene, range, bounds);
  std::vector<Bounds> objects(scene.objects.size());
  for (size_t i = 0; i < objects.size(); ++i) {
    const Object& object = scene.objects[i];
    AddTriangles(scene, {object.first_triangle, object.triangle_count}, objects[i]);
    AddSpheres(scene, {object.first_sphere, object.sphere_count}, objects[i]);
  }
  for (const InstanceRecord& instance : scene.instances) {
    AddInstance(instance, objects[instance.object], bounds);
  }
  return bounds;
}

PrimCounts CountDrawn(const Scene& scene) {
  PrimCounts counts{scene.triangle_count(), scene.spheres.size()};
  for (const Object& object : scene.objects) {
    counts.triangles -= object.triangle_count;
    counts.spheres -= object.sphere_count;
  }
  for (const InstanceRecord& instance : scene.instances) {
    counts.triangles += scene.objects[instance.object].triangle_count;
    counts.spheres += scene.objects[instance.object].sphere_count;
  }
  return counts;
}

}  // namespace swell
