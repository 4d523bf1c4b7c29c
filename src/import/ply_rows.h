// What readers of vertices, faces and other elements of a PLY file share: errors that name the
// place, and properties that nobody asked for.
#ifndef SWELL_IMPORT_PLY_ROWS_H_
#define SWELL_IMPORT_PLY_ROWS_H_

#include <cstdint>
#include <string>

#include "src/import/ply_header.h"

namespace swell {

// Reads rows with the source's errors. Its readers of elements share one source.
template <class Source> class PlyRows {
 public:
  explicit PlyRows(Source& source) : source_(source) {}

  Error Fail(const std::string& what) const {
    return Error{": " + what + " at " + source_.Where()};
  }
  Error Truncated(const PlyElement& element, uint64_t row) const {
    return Fail("the file ends or has no number in " + std::string(element.name) + " " +
                std::to_string(row) + " of " + std::to_string(element.count));
  }

  bool SkipProperty(const PlyProperty& property) {
    double value = 0.0;
    if (!property.count_type) return source_.Next(property.type, &value);
    double count = 0.0;
    if (!source_.Next(*property.count_type, &count) || !(count >= 0.0)) return false;
    for (double i = 0.0; i < count; i += 1.0) {
      if (!source_.Next(property.type, &value)) return false;
    }
    return true;
  }

 protected:
  Source& source_;
};

}  // namespace swell

#endif  // SWELL_IMPORT_PLY_ROWS_H_
