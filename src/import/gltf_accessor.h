// Accessors of a glTF file -> floats and indices: every type, normalised or not, sparse or not.
#ifndef SWELL_IMPORT_GLTF_ACCESSOR_H_
#define SWELL_IMPORT_GLTF_ACCESSOR_H_

#include <vector>

#include "src/import/gltf_file.h"

namespace swell {

// Rows of numbers, `width` together.
struct GltfRows {
  uint32_t width = 0;
  std::vector<float> values;

  size_t count() const { return width == 0 ? 0 : values.size() / width; }
};

// Rows that the accessor has.
Result<uint64_t> CountRows(const GltfFile& file, int accessor);

// Rows [first, first + count), which must be there.
Result<GltfRows> ReadRows(const GltfFile& file, int accessor, uint64_t first, uint64_t count);
Result<GltfRows> ReadAllRows(const GltfFile& file, int accessor);

Result<std::vector<uint32_t>> ReadIndices(const GltfFile& file, int accessor);

}  // namespace swell

#endif  // SWELL_IMPORT_GLTF_ACCESSOR_H_
