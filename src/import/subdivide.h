// Control meshes -> the limit surfaces of Loop's subdivision, as finer meshes.
#ifndef SWELL_IMPORT_SUBDIVIDE_H_
#define SWELL_IMPORT_SUBDIVIDE_H_

#include <array>
#include <cstdint>
#include <vector>

#include "src/base/result.h"
#include "src/import/transform.h"

namespace swell {

inline constexpr int kMaxSubdivisionLevels = 12;
inline constexpr uint64_t kMaxSubdividedFaces = uint64_t{1} << 24;

struct ControlMesh {
  std::vector<Point> points;
  std::vector<std::array<uint32_t, 3>> faces;
};

struct SmoothMesh {
  std::vector<Point> points, normals;  // of the limit surface; normals of any length
  std::vector<std::array<uint32_t, 3>> faces;
};

// Fails where more than two faces share an edge, where neighbours wind differently and for more
// faces than kMaxSubdividedFaces. Points that no face has are kept, without a normal.
Result<SmoothMesh> SubdivideLoop(ControlMesh mesh, int levels);

}  // namespace swell

#endif  // SWELL_IMPORT_SUBDIVIDE_H_
