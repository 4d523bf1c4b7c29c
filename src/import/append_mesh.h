// Rows of a mesh in its own space -> a shape of the scene, for all kinds of shapes that become
// meshes.
#ifndef SWELL_IMPORT_APPEND_MESH_H_
#define SWELL_IMPORT_APPEND_MESH_H_

#include <vector>

#include "src/import/shapes.h"

namespace swell {

inline constexpr double kPi = 3.14159265358979323846;

inline Point Row3(const std::vector<float>& values, size_t row) {
  return {values[3 * row], values[3 * row + 1], values[3 * row + 2]};
}

inline void AppendPoint(std::vector<float>* values, const Point& p) {
  for (const double value : p) values->push_back(static_cast<float>(value));
}

inline Point Minus(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

// pbrt gives "power" to every primitive of its own; `units` of them share `area`.
void SetEmission(Shape& shape, Diagnostics& diagnostics, const Placement& placement, double area,
                 double units);

// As FinishMesh, of `units` primitives of pbrt.
inline constexpr double kEveryTriangle = 0.0;
void AppendMesh(Scene& scene, Diagnostics& diagnostics, const Placement& placement,
                const MeshStart& start, double units);

}  // namespace swell

#endif  // SWELL_IMPORT_APPEND_MESH_H_
