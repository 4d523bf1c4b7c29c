// Shapes of scene files in their own space -> rows of the scene in world space.
#ifndef SWELL_IMPORT_SHAPES_H_
#define SWELL_IMPORT_SHAPES_H_

#include <array>
#include <cstdint>
#include <string>

#include "src/import/diagnostics.h"
#include "src/import/transform.h"
#include "src/scene/scene.h"

namespace swell {

inline constexpr uint64_t kMaxVertices = 0x7FFFFFFFu / 3;  // and triangles, of a scene

struct Emission {
  bool emits = false;
  bool two_sided = false;
  std::array<float, 3> radiance{};  // per unit of `power`, if that is given
  float power = 0.0f;               // above 0: the shape's power, which sets its radiance
  uint32_t image = kNoTexture;      // row of the scene's image_lights, times radiance
};

// What the state of the file says of the next shape.
struct Placement {
  Transform object_to_world;
  bool reverse_orientation = false;
  uint32_t material = 0;
  Emission emission;
  uint32_t alpha = kNoTexture;  // as in Shape, like what follows
  uint32_t inside = kVacuum, outside = kVacuum;
  bool border = false;
  bool in_object = false;
  Place place;
  std::string name;  // for messages
};

// With what the placement says of it, but for its record and its emission.
Shape MakeShape(const Placement& placement);

// Rows of the scene's arrays at which a mesh starts.
struct MeshStart {
  size_t positions, normals, uvs, indices;
};
MeshStart BeginMesh(const Scene& scene);

// Finishes the mesh whose object-space vertices and triangles were appended since `start`: maps it
// to the world, drops triangles without area and unusable normals, appends its shape.
void FinishMesh(Scene& scene, Diagnostics& diagnostics, const Placement& placement,
                const MeshStart& start);

void AddSphere(Scene& scene, Diagnostics& diagnostics, const Placement& placement, double radius);

struct PartialSphere {
  double radius, z_min, z_max, phi_max_degrees;
};
void AddPartialSphere(Scene& scene, Diagnostics& diagnostics, const Placement& placement,
                      const PartialSphere& sphere);

struct Cylinder {
  double radius, z_min, z_max, phi_max_degrees;
};
void AddCylinder(Scene& scene, Diagnostics& diagnostics, const Placement& placement,
                 const Cylinder& cylinder);

struct Disk {
  double height, radius, inner_radius, phi_max_degrees;
};
void AddDisk(Scene& scene, Diagnostics& diagnostics, const Placement& placement, const Disk& disk);

// Patches of 4 vertices (00 10 01 11) -> triangles. The vertices were appended since `start`;
// patches that are not flat are divided and get new vertices.
void AddBilinearPatches(Scene& scene, Diagnostics& diagnostics, const Placement& placement,
                        const MeshStart& start, const std::vector<uint32_t>& corners);

// Puts the spheres' rows behind the triangles' in prim_shape. To be called once, at the end.
void FinishPrimitives(Scene& scene);

}  // namespace swell

#endif  // SWELL_IMPORT_SHAPES_H_
