// A PLY file (ASCII, binary of either byte order) -> triangles appended to arrays.
#ifndef SWELL_IMPORT_PLY_H_
#define SWELL_IMPORT_PLY_H_

#include <cstdint>
#include <string>
#include <vector>

#include "src/base/result.h"

namespace swell {

// Caller-owned arrays that grow; earlier rows are not touched.
struct PlyArrays {
  std::vector<float>* positions;   // x y z
  std::vector<float>* normals;     // x y z, as in the file; only if it has them
  std::vector<float>* uvs;         // u v; likewise
  std::vector<uint32_t>* indices;  // 3 per triangle, counted from the first row of `positions`
};

struct PlyContents {
  uint32_t vertices = 0;
  uint64_t triangles = 0;
  uint64_t short_faces = 0;  // of fewer than 3 vertices; left out
  bool has_normals = false;
  bool has_uvs = false;
};

// Faces of more than three vertices become fans. Errors name the line or byte.
Result<PlyContents> ReadPly(const std::string& path, const PlyArrays& arrays);

}  // namespace swell

#endif  // SWELL_IMPORT_PLY_H_
