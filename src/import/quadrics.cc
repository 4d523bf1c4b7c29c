// Spheres -> rows of spheres; partial spheres, cylinders and disks -> meshes.
#include <algorithm>
#include <cmath>

#include "src/import/append_mesh.h"
#include "src/import/shapes.h"

namespace swell {
namespace {

constexpr double kSegmentsPerTurn = 256.0;  // of disks, cylinders and partial spheres

Point OnCircle(double radius, double phi, double z) {
  return {radius * std::cos(phi), radius * std::sin(phi), z};
}

// Of a part of a turn, in radians.
uint32_t SegmentsOf(double angle) {
  return static_cast<uint32_t>(
      std::max(8.0, std::ceil(kSegmentsPerTurn * std::abs(angle) / (2.0 * kPi))));
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
  Shape shape = MakeShape(placement);
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
  const uint32_t columns = SegmentsOf(phi_max), rows = SegmentsOf(theta_max - theta_min);
  for (uint32_t j = 0; j <= rows; ++j) {
    const double v = static_cast<double>(j) / rows;
    const double theta = theta_min + v * (theta_max - theta_min);
    for (uint32_t i = 0; i <= columns; ++i) {
      const double u = static_cast<double>(i) / columns;
      const Point n = OnCircle(std::sin(theta), u * phi_max, std::cos(theta));
      AppendPoint(&scene.positions,
                  {sphere.radius * n[0], sphere.radius * n[1], sphere.radius * n[2]});
      AppendPoint(&scene.normals, n);
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

void AddCylinder(Scene& scene, Diagnostics& diagnostics, const Placement& placement,
                 const Cylinder& cylinder) {
  const MeshStart start = BeginMesh(scene);
  const auto first = static_cast<uint32_t>(start.positions / 3);
  const double phi_max = cylinder.phi_max_degrees * kPi / 180.0;
  const uint32_t segments = SegmentsOf(phi_max);
  const double step = phi_max / segments;
  // Corners stand out of the circle by as much as gives the strip the cylinder's area.
  const double radius = cylinder.radius * (step / 2.0) / std::sin(step / 2.0);
  for (uint32_t i = 0; i <= segments; ++i) {
    for (uint32_t top = 0; top < 2; ++top) {
      AppendPoint(&scene.positions,
                  OnCircle(radius, i * step, top == 0 ? cylinder.z_min : cylinder.z_max));
      AppendPoint(&scene.normals, OnCircle(1.0, i * step, 0.0));
      scene.uvs.insert(scene.uvs.end(),
                       {static_cast<float>(static_cast<double>(i) / segments), top * 1.0f});
    }
    if (i == 0) continue;
    const uint32_t a = first + 2 * i - 2;
    scene.indices.insert(scene.indices.end(), {a, a + 2, a + 3, a, a + 3, a + 1});
  }
  AppendMesh(scene, diagnostics, placement, start, 1.0);
}

void AddDisk(Scene& scene, Diagnostics& diagnostics, const Placement& placement, const Disk& disk) {
  const MeshStart start = BeginMesh(scene);
  const auto first = static_cast<uint32_t>(start.positions / 3);
  const double phi_max = disk.phi_max_degrees * kPi / 180.0;
  const uint32_t segments = SegmentsOf(phi_max);
  const double step = phi_max / segments;
  // Corners stand out of the circle by as much as gives the polygon the circle's area.
  const double stretch = std::sqrt(step / std::sin(step));
  const bool ring = disk.inner_radius > 0.0;
  for (uint32_t i = 0; i <= segments; ++i) {
    const double u = static_cast<double>(i) / segments;
    for (double radius : {disk.radius, disk.inner_radius}) {
      AppendPoint(&scene.positions, OnCircle(radius * stretch, i * step, disk.height));
      const double v = (disk.radius - radius) / (disk.radius - disk.inner_radius);
      scene.uvs.insert(scene.uvs.end(), {static_cast<float>(u), static_cast<float>(v)});
    }
    if (i == 0) continue;
    const uint32_t outer = first + 2 * i, inner = outer + 1;
    scene.indices.insert(scene.indices.end(), {outer - 2, outer, inner});
    if (ring) scene.indices.insert(scene.indices.end(), {outer - 2, inner, inner - 2});
  }
  AppendMesh(scene, diagnostics, placement, start, 1.0);
}

}  // namespace swell
