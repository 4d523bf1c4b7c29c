// The header of a PLY file -> its elements and their properties.
#ifndef SWELL_IMPORT_PLY_HEADER_H_
#define SWELL_IMPORT_PLY_HEADER_H_

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "src/base/result.h"

namespace swell {

enum class PlyScalar { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

inline size_t PlySizeOf(PlyScalar type) {
  constexpr size_t kSizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<size_t>(type)];
}

struct PlyProperty {
  std::string_view name;
  PlyScalar type = PlyScalar::kFloat;
  std::optional<PlyScalar> count_type;  // of lists
};

struct PlyElement {
  std::string_view name;
  uint64_t count = 0;
  uint32_t line = 0;
  std::vector<PlyProperty> properties;

  std::optional<size_t> FindScalar(std::string_view property) const;
  std::optional<size_t> FindIndices() const;  // the list of a face's vertices
};

enum class PlyEncoding { kAscii, kLittle, kBig };

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::kAscii;
  std::vector<PlyElement> elements;
  size_t size = 0;  // bytes up to the first value
  uint32_t lines = 0;
};

// ":LINE: what", to stand behind the file's path.
Error PlyErrorAt(uint32_t line, const std::string& what);

// `data` is the whole file. Errors begin with ":LINE: " or ": ".
Result<PlyHeader> ReadPlyHeader(std::string_view data);

}  // namespace swell

#endif  // SWELL_IMPORT_PLY_HEADER_H_
