// Placing, dividing and checking of shapes.
#include "src/import/shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swell {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kSegmentsPerTurn = 256.0;  // of disks and partial spheres
constexpr uint32_t kPatchSteps = 16;        // per side of a bilinear patch that is not flat
constexpr uint64_t kMaxVertices = 0x7FFFFFFFu / 3;

// Squared doubled area below which a triangle's normal cannot be computed with floats.
constexpr double kMinCrossSquared = 1.2e-38;

Point Row3(const std::vector<float>& values, size_t row) {
  return {values[3 * row], values[3 * row + 1], values[3 * row + 2]};
}

Point Minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

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

// pbrt gives "power" to every primitive of its own; `units` of them share `area`.
constexpr double kEveryTriangle = 0.0;
void SetEmission(Shape& shape, Diagnostics& diagnostics, const Placement& placement, double area,
                 double units) {
  const Emission& emission = placement.emission;
  shape.emits = emission.emits;
  shape.two_sided = emission.two_sided;
  shape.radiance = emission.radiance;
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

void AppendMesh(Scene& scene, Diagnostics& diagnostics, const Placement& placement,
                const MeshStart& start, double units);

Point OnCircle(double radius, double phi, double z) {
  return {radius * std::cos(phi), radius * std::sin(phi), z};
}

void AppendVertex(std::vector<float>& values, const Point& p) {
  for (double value : p) values.push_back(static_cast<float>(value));
}

}  // namespace

MeshStart BeginMesh(const Scene& scene) {
  return {scene.positions.size(), scene.normals.size(), scene.uvs.size(), scene.indices.size()};
}

void FinishMesh(Scene& scene, Diagnostics& diagnostics, const Placement& placement,
                const MeshStart& start) {
  AppendMesh(scene, diagnostics, placement, start, kEveryTriangle);
}

namespace {

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
  if (areas.dropped > 0) {
    diagnostics.Warn(placement.place, placement.name + ": " + std::to_string(areas.dropped) +
                                          " triangles without area are left out");
  }
  const size_t triangles = (scene.indices.size() - start.indices) / 3;
  if (triangles == 0) {
    return diagnostics.Warn(placement.place, placement.name + ": has no triangles");
  }

  Shape shape;
  shape.record.material = placement.material;
  shape.record.first_light = kNone;
  shape.record.first_prim = static_cast<uint32_t>(start.indices / 3);
  shape.record.prim_count = static_cast<uint32_t>(triangles);
  shape.record.normal_offset = kNone;
  shape.record.uv_offset = kNone;
  shape.record.sphere = kNone;
  if (scene.normals.size() > start.normals) {
    shape.record.normal_offset = static_cast<uint32_t>(start.normals / 3 - first_vertex);
    shape.record.flags |= kShapeNormalsOrient;
  }
  if (scene.uvs.size() > start.uvs) {
    shape.record.uv_offset = static_cast<uint32_t>(start.uvs / 2 - first_vertex);
  }
  // A mirrored triangle winds the other way; flipping its normal keeps the outside outside.
  if (placement.reverse_orientation != (Determinant(placement.object_to_world) < 0.0)) {
    shape.record.flags |= kShapeFlipNormal;
  }
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

// Area of the image of the unit sphere.
double EllipsoidArea(const Transform& t) {
  constexpr int kRings = 128, kSteps = 128;
  const std::array<double, 9> c = Cofactors(t);
  double sum = 0.0;
  for (int i = 0; i < kRings; ++i) {
    const double z = -1.0 + 2.0 * (i + 0.5) / kRings;
    for (int j = 0; j < kSteps; ++j) {
      const Point n = OnCircle(std::sqrt(1.0 - z * z), 2.0 * kPi * (j + 0.5) / kSteps, z);
      const Point image{c[0] * n[0] + c[1] * n[1] + c[2] * n[2],
                        c[3] * n[0] + c[4] * n[1] + c[5] * n[2],
                        c[6] * n[0] + c[7] * n[1] + c[8] * n[2]};
      sum += std::sqrt(Dot(image, image));
    }
  }
  return 4.0 * kPi * sum / (kRings * kSteps);
}

}  // namespace

void AddSphere(Scene& scene, Diagnostics& diagnostics, const Placement& placement, double radius) {
  const Transform unit_to_world = placement.object_to_world * Scale(radius, radius, radius);
  const auto world_to_unit = Inverse(unit_to_world);
  const auto finite = [](float value) { return std::isfinite(value); };
  SphereRecord record{};
  if (world_to_unit) {
    const Affine to_world = ToAffine(unit_to_world), to_object = ToAffine(*world_to_unit);
    std::copy(to_world.begin(), to_world.end(), record.object_to_world);
    std::copy(to_object.begin(), to_object.end(), record.world_to_object);
  }
  if (!world_to_unit || !std::all_of(record.object_to_world, record.object_to_world + 12, finite) ||
      !std::all_of(record.world_to_object, record.world_to_object + 12, finite)) {
    return diagnostics.Fail(placement.place,
                            placement.name + ": the transform flattens it; use non-zero scales");
  }
  Shape shape;
  shape.record.material = placement.material;
  shape.record.first_light = kNone;
  shape.record.prim_count = 1;
  shape.record.normal_offset = kNone;
  shape.record.uv_offset = kNone;
  shape.record.sphere = static_cast<uint32_t>(scene.spheres.size());
  // A sphere's outward normal stays outward in a mirror, so only the file's word turns it.
  shape.record.flags = kShapeIsSphere | (placement.reverse_orientation ? kShapeFlipNormal : 0u);
  SetEmission(shape, diagnostics, placement,
              placement.emission.power > 0.0f ? EllipsoidArea(unit_to_world) : 1.0, 1.0);
  scene.spheres.push_back(record);
  scene.shapes.push_back(shape);
}

void AddPartialSphere(Scene& scene, Diagnostics& diagnostics, const Placement& placement,
                      const PartialSphere& sphere) {
  const MeshStart start = BeginMesh(scene);
  const auto first = static_cast<uint32_t>(start.positions / 3);
  const auto polar = [&](double z) { return std::acos(std::clamp(z / sphere.radius, -1.0, 1.0)); };
  const double theta_min = polar(sphere.z_min), theta_max = polar(sphere.z_max);
  const double phi_max = sphere.phi_max_degrees * kPi / 180.0;
  const auto steps = [](double angle) {
    return static_cast<uint32_t>(
        std::max(8.0, std::ceil(kSegmentsPerTurn * std::abs(angle) / (2.0 * kPi))));
  };
  const uint32_t columns = steps(phi_max), rows = steps(theta_max - theta_min);
  for (uint32_t j = 0; j <= rows; ++j) {
    const double v = static_cast<double>(j) / rows;
    const double theta = theta_min + v * (theta_max - theta_min);
    for (uint32_t i = 0; i <= columns; ++i) {
      const double u = static_cast<double>(i) / columns;
      const Point n = OnCircle(std::sin(theta), u * phi_max, std::cos(theta));
      AppendVertex(scene.positions,
                   {sphere.radius * n[0], sphere.radius * n[1], sphere.radius * n[2]});
      AppendVertex(scene.normals, n);
      scene.uvs.insert(scene.uvs.end(), {static_cast<float>(u), static_cast<float>(v)});
    }
  }
  for (uint32_t j = 0; j < rows; ++j) {
    for (uint32_t i = 0; i < columns; ++i) {
      const uint32_t a = first + j * (columns + 1) + i, b = a + columns + 1;
      // At a pole one of the two triangles of a cell has no area.
      const bool south_pole = j == 0 && sphere.z_min <= -sphere.radius;
      const bool north_pole = j + 1 == rows && sphere.z_max >= sphere.radius;
      if (!south_pole) scene.indices.insert(scene.indices.end(), {a, a + 1, b + 1});
      if (!north_pole) scene.indices.insert(scene.indices.end(), {a, b + 1, b});
    }
  }
  AppendMesh(scene, diagnostics, placement, start, 1.0);
}

void AddDisk(Scene& scene, Diagnostics& diagnostics, const Placement& placement, const Disk& disk) {
  const MeshStart start = BeginMesh(scene);
  const auto first = static_cast<uint32_t>(start.positions / 3);
  const double phi_max = disk.phi_max_degrees * kPi / 180.0;
  const auto segments =
      static_cast<uint32_t>(std::max(8.0, std::ceil(kSegmentsPerTurn * phi_max / (2.0 * kPi))));
  const double step = phi_max / segments;
  // Corners stand out of the circle by as much as gives the polygon the circle's area.
  const double stretch = std::sqrt(step / std::sin(step));
  const bool ring = disk.inner_radius > 0.0;
  for (uint32_t i = 0; i <= segments; ++i) {
    const double u = static_cast<double>(i) / segments;
    for (double radius : {disk.radius, disk.inner_radius}) {
      AppendVertex(scene.positions, OnCircle(radius * stretch, i * step, disk.height));
      const double v = (disk.radius - radius) / disk.radius;
      scene.uvs.insert(scene.uvs.end(), {static_cast<float>(u), static_cast<float>(v)});
    }
    if (i == 0) continue;
    const uint32_t outer = first + 2 * i, inner = outer + 1;
    scene.indices.insert(scene.indices.end(), {outer - 2, outer, inner});
    if (ring) scene.indices.insert(scene.indices.end(), {outer - 2, inner, inner - 2});
  }
  AppendMesh(scene, diagnostics, placement, start, 1.0);
}

void AddBilinearPatches(Scene& scene, Diagnostics& diagnostics, const Placement& placement,
                        const MeshStart& start, const std::vector<uint32_t>& patches) {
  const auto first = static_cast<uint32_t>(start.positions / 3);
  const bool normals = scene.normals.size() > start.normals, uvs = scene.uvs.size() > start.uvs;
  const size_t normal_row = start.normals / 3, uv_row = start.uvs / 2;
  constexpr double kFlat = 1e-6;  // height over diagonal
  for (size_t p = 0; p + 3 < patches.size(); p += 4) {
    const uint32_t* corner = &patches[p];
    std::array<Point, 4> at;
    for (size_t k = 0; k < 4; ++k) at[k] = Row3(scene.positions, first + corner[k]);
    const Point diagonal = Minus(at[3], at[0]), across = Minus(at[2], at[1]);
    const Point normal = Cross(diagonal, across);
    const double height = std::abs(Dot(normal, Minus(at[1], at[0])));
    const double size =
        std::sqrt(Dot(normal, normal) * std::max(Dot(diagonal, diagonal), Dot(across, across)));
    if (height <= kFlat * size) {
      const uint32_t a = first + corner[0], b = first + corner[1], c = first + corner[2],
                     d = first + corner[3];
      scene.indices.insert(scene.indices.end(), {a, b, d, a, d, c});
      continue;
    }
    diagnostics.Warn(placement.place, placement.name + ": a curved patch is divided into " +
                                          std::to_string(2 * kPatchSteps * kPatchSteps) +
                                          " triangles");
    const auto base = static_cast<uint32_t>(scene.positions.size() / 3);
    for (uint32_t j = 0; j <= kPatchSteps; ++j) {
      for (uint32_t i = 0; i <= kPatchSteps; ++i) {
        const double u = static_cast<double>(i) / kPatchSteps;
        const double v = static_cast<double>(j) / kPatchSteps;
        const double weight[4] = {(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v};
        const auto blend = [&](std::vector<float>& values, size_t first_row, size_t width) {
          for (size_t c = 0; c < width; ++c) {
            double sum = 0.0;
            for (size_t k = 0; k < 4; ++k) {
              sum += weight[k] * values[(first_row + corner[k]) * width + c];
            }
            values.push_back(static_cast<float>(sum));
          }
        };
        blend(scene.positions, first, 3);
        if (normals) blend(scene.normals, normal_row, 3);
        if (uvs) blend(scene.uvs, uv_row, 2);
        if (i == kPatchSteps || j == kPatchSteps) continue;
        const uint32_t a = base + j * (kPatchSteps + 1) + i, b = a + kPatchSteps + 1;
        scene.indices.insert(scene.indices.end(), {a, a + 1, b + 1, a, b + 1, b});
      }
    }
  }
  AppendMesh(scene, diagnostics, placement, start, static_cast<double>(patches.size() / 4));
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
