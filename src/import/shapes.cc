// Placing and checking of meshes: to the world, without what has no area, with its emission.
#include "src/import/shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/import/append_mesh.h"

namespace swell {
namespace {

// Squared doubled area below which a triangle's normal cannot be computed with floats.
constexpr double kMinCrossSquared = 1.2e-38;

bool StoreRow3(std::vector<float>& values, size_t row, const Point& p) {
  bool finite = true;
  for (size_t c = 0; c < 3; ++c) {
    const auto value = static_cast<float>(p[c]);
    values[3 * row + c] = value;
    finite = finite && std::isfinite(value);
  }
  return finite;
}

// Normals of the mesh to the world, unit length, on the side that the file asks for. False if one
// has no direction.
bool PlaceNormals(Scene& scene, const Placement& placement, size_t first_row) {
  const std::array<double, 9> cofactors = Cofactors(placement.object_to_world);
  const double sign = (Determinant(placement.object_to_world) < 0.0 ? -1.0 : 1.0) *
                      (placement.reverse_orientation ? -1.0 : 1.0);
  for (size_t row = first_row; row < scene.normals.size() / 3; ++row) {
    const Point n = Row3(scene.normals, row);
    const auto unit = Normalized({cofactors[0] * n[0] + cofactors[1] * n[1] + cofactors[2] * n[2],
                                  cofactors[3] * n[0] + cofactors[4] * n[1] + cofactors[5] * n[2],
                                  cofactors[6] * n[0] + cofactors[7] * n[1] + cofactors[8] * n[2]});
    if (!unit ||
        !StoreRow3(scene.normals, row, {sign * (*unit)[0], sign * (*unit)[1], sign * (*unit)[2]})) {
      return false;
    }
  }
  return true;
}

struct Areas {
  double sum = 0.0, least = std::numeric_limits<double>::infinity(), most = 0.0;
  uint64_t dropped = 0;
};

// Keeps the triangles that have an area.
Areas DropDegenerate(Scene& scene, size_t first_index) {
  Areas areas;
  size_t out = first_index;
  for (size_t i = first_index; i < scene.indices.size(); i += 3) {
    const Point a = Row3(scene.positions, scene.indices[i]);
    const Point b = Row3(scene.positions, scene.indices[i + 1]);
    const Point c = Row3(scene.positions, scene.indices[i + 2]);
    const Point cross = Cross(Minus(b, a), Minus(c, a));
    const double squared = Dot(cross, cross);
    if (!(squared >= kMinCrossSquared)) {
      ++areas.dropped;
      continue;
    }
    const double area = 0.5 * std::sqrt(squared);
    areas.sum += area;
    areas.least = std::min(areas.least, area);
    areas.most = std::max(areas.most, area);
    for (size_t k = 0; k < 3; ++k) scene.indices[out + k] = scene.indices[i + k];
    out += 3;
  }
  scene.indices.resize(out);
  return areas;
}

// Of the mesh whose rows since `start` are finished.
ShapeRecord MeshRecord(const Scene& scene, const Placement& placement, const MeshStart& start) {
  const size_t first_vertex = start.positions / 3;
  ShapeRecord record{};
  record.material = placement.material;
  record.first_light = kNone;
  record.first_prim = static_cast<uint32_t>(start.indices / 3);
  record.prim_count = static_cast<uint32_t>((scene.indices.size() - start.indices) / 3);
  record.normal_offset = kNone;
  record.uv_offset = kNone;
  record.sphere = kNone;
  if (scene.normals.size() > start.normals) {
    record.normal_offset = static_cast<uint32_t>(start.normals / 3 - first_vertex);
    record.flags |= kShapeNormalsOrient;
  }
  if (scene.uvs.size() > start.uvs) {
    record.uv_offset = static_cast<uint32_t>(start.uvs / 2 - first_vertex);
  }
  // A mirrored triangle winds the other way; flipping its normal keeps the outside outside.
  if (placement.reverse_orientation != (Determinant(placement.object_to_world) < 0.0)) {
    record.flags |= kShapeFlipNormal;
  }
  return record;
}

}  // namespace

Shape MakeShape(const Placement& placement) {
  Shape shape;
  shape.alpha = placement.alpha;
  shape.inside = placement.inside;
  shape.outside = placement.outside;
  shape.border = placement.border;
  return shape;
}

void SetEmission(Shape& shape, Diagnostics& diagnostics, const Placement& placement, double area,
                 double units) {
  const Emission& emission = placement.emission;
  shape.emits = emission.emits;
  shape.two_sided = emission.two_sided;
  shape.radiance = emission.radiance;
  shape.emission_image = emission.image;
  if (!emission.emits || !(emission.power > 0.0f)) return;
  const double scale = emission.power * units / (kPi * area * (emission.two_sided ? 2.0 : 1.0));
  for (float& channel : shape.radiance) {
    channel = static_cast<float>(channel * scale);
    if (!std::isfinite(channel)) {
      diagnostics.Fail(placement.place,
                       placement.name + ": its \"power\" makes it infinitely bright");
    }
  }
}

MeshStart BeginMesh(const Scene& scene) {
  return {scene.positions.size(), scene.normals.size(), scene.uvs.size(), scene.indices.size()};
}

void FinishMesh(Scene& scene, Diagnostics& diagnostics, const Placement& placement,
                const MeshStart& start) {
  AppendMesh(scene, diagnostics, placement, start, kEveryTriangle);
}

void AppendMesh(Scene& scene, Diagnostics& diagnostics, const Placement& placement,
                const MeshStart& start, double units) {
  const size_t first_vertex = start.positions / 3;
  if (scene.positions.size() / 3 > kMaxVertices || scene.indices.size() / 3 > kMaxVertices) {
    return diagnostics.Fail(
        placement.place,
        "the scene has more than " + std::to_string(kMaxVertices) + " vertices or triangles");
  }
  for (size_t row = first_vertex; row < scene.positions.size() / 3; ++row) {
    const Point world = MapPoint(placement.object_to_world, Row3(scene.positions, row));
    if (!StoreRow3(scene.positions, row, world)) {
      return diagnostics.Fail(placement.place, placement.name + ": vertex " +
                                                   std::to_string(row - first_vertex) +
                                                   " is not finite in world space");
    }
  }
  if (scene.normals.size() > start.normals && !PlaceNormals(scene, placement, start.normals / 3)) {
    diagnostics.Warn(placement.place, placement.name +
                                          ": a normal is zero or not finite; the mesh is rendered "
                                          "without its normals");
    scene.normals.resize(start.normals);
  }
  const Areas areas = DropDegenerate(scene, start.indices);
  scene.left_out_triangles += areas.dropped;
  if (areas.dropped > 0) {
    diagnostics.Warn(placement.place, placement.name + ": " + std::to_string(areas.dropped) +
                                          " triangles without area are left out");
  }
  const size_t triangles = (scene.indices.size() - start.indices) / 3;
  if (triangles == 0) {
    return diagnostics.Warn(placement.place, placement.name + ": has no triangles");
  }

  Shape shape = MakeShape(placement);
  shape.record = MeshRecord(scene, placement, start);
  const bool per_triangle = units == kEveryTriangle;
  if (placement.emission.power > 0.0f && per_triangle && areas.most > 1.001 * areas.least) {
    diagnostics.Warn(placement.place,
                     placement.name +
                         ": \"power\" is given to every triangle, as in pbrt, but spread evenly "
                         "over the mesh, whose triangles differ in size");
  }
  SetEmission(shape, diagnostics, placement, areas.sum,
              per_triangle ? static_cast<double>(triangles) : units);
  scene.prim_shape.insert(scene.prim_shape.end(), triangles,
                          static_cast<uint32_t>(scene.shapes.size()));
  scene.shapes.push_back(shape);
}

void FinishPrimitives(Scene& scene) {
  const auto triangles = static_cast<uint32_t>(scene.triangle_count());
  scene.prim_shape.resize(triangles + scene.spheres.size());
  for (size_t i = 0; i < scene.shapes.size(); ++i) {
    ShapeRecord& record = scene.shapes[i].record;
    if ((record.flags & kShapeIsSphere) == 0) continue;
    record.first_prim = triangles + record.sphere;
    scene.prim_shape[record.first_prim] = static_cast<uint32_t>(i);
  }
}

}  // namespace swell
