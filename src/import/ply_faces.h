// The faces of a PLY file -> triangles, with a direct path for the layout that large binary meshes
// have.
#ifndef SWELL_IMPORT_PLY_FACES_H_
#define SWELL_IMPORT_PLY_FACES_H_

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>

#include "src/import/ply.h"
#include "src/import/ply_header.h"
#include "src/import/ply_rows.h"
#include "src/import/ply_source.h"

namespace swell {

inline constexpr uint64_t kMaxPlyIndices = 0x7FFFFFFFu;

// Appends the faces' triangles to the indices; the vertices come first.
template <class Source> class PlyFaces : private PlyRows<Source> {
 public:
  // `first_vertex` is the row of the file's first vertex.
  PlyFaces(Source& source, const PlyArrays& arrays, size_t first_vertex, PlyContents* contents)
      : Rows(source), arrays_(arrays), contents_(*contents), first_vertex_(first_vertex) {}

  Status Read(const PlyElement& element) {
    const auto list = element.FindIndices();
    if (!list) {
      return PlyErrorAt(element.line, "faces have no list 'vertex_indices'");
    }
    if (contents_.vertices == 0) {
      return PlyErrorAt(element.line, "faces come before their vertices");
    }
    const PlyProperty& indices = element.properties[*list];
    const uint64_t triangle_bytes = Source::MinBytes(element) + Source::MinListBytes(indices, 3);
    const uint64_t likely = std::min(element.count, source_.remaining() / triangle_bytes + 1);
    const size_t first_index = arrays_.indices->size();
    arrays_.indices->reserve(first_index + static_cast<size_t>(3 * likely));
    uint64_t row = 0;
    if constexpr (std::is_same_v<Source, PlyBinarySource>) {
      if (!source_.swap() && element.properties.size() == 1 &&
          *indices.count_type == PlyScalar::kUint8 &&
          (indices.type == PlyScalar::kInt32 || indices.type == PlyScalar::kUint32)) {
        row = ReadPlainTriangles(row, element.count);
      }
    }
    for (; row < element.count; ++row) {
      for (size_t i = 0; i < element.properties.size(); ++i) {
        if (i == *list) {
          if (Status status = ReadFace(element, indices, row); !status) return status;
        } else if (!SkipProperty(element.properties[i])) {
          return Truncated(element, row);
        }
      }
      if (arrays_.indices->size() > kMaxPlyIndices) {
        return Fail("more than " + std::to_string(kMaxPlyIndices / 3) + " triangles in the scene");
      }
    }
    return Done{};
  }

 private:
  using Rows = PlyRows<Source>;
  using Rows::Fail;
  using Rows::SkipProperty;
  using Rows::source_;
  using Rows::Truncated;

  // Faces of the usual layout (uchar 3, three 32-bit indices) from row `row` on, as long as they
  // are triangles with valid indices. Returns the first row that needs the general reader.
  uint64_t ReadPlainTriangles(uint64_t row, uint64_t count) {
    constexpr size_t kRowBytes = 1 + 3 * sizeof(uint32_t);
    const char* in = source_.bytes();
    const uint64_t available = std::min(count - row, source_.remaining() / kRowBytes);
    const size_t out = arrays_.indices->size();
    if (out + 3 * available > kMaxPlyIndices) return row;
    arrays_.indices->resize(out + 3 * available);
    uint32_t* indices = arrays_.indices->data() + out;
    uint64_t done = 0;
    for (; done < available && *in == 3; ++done, in += kRowBytes) {
      uint32_t triangle[3];
      std::memcpy(triangle, in + 1, sizeof(triangle));
      if (std::max({triangle[0], triangle[1], triangle[2]}) >= contents_.vertices) break;
      for (size_t k = 0; k < 3; ++k) {
        indices[3 * done + k] = triangle[k] + static_cast<uint32_t>(first_vertex_);
      }
    }
    arrays_.indices->resize(out + 3 * done);
    source_.Skip(kRowBytes * done);
    return row + done;
  }

  Status ReadFace(const PlyElement& element, const PlyProperty& list, uint64_t row) {
    double corners = 0.0;
    if (!source_.Next(*list.count_type, &corners)) return Truncated(element, row);
    if (!(corners >= 0.0) || corners > static_cast<double>(source_.remaining())) {
      return Fail("face " + std::to_string(row) + " has an impossible number of vertices");
    }
    uint32_t first = 0, last = 0;
    for (double i = 0.0; i < corners; i += 1.0) {
      double value = 0.0;
      if (!source_.Next(list.type, &value)) return Truncated(element, row);
      if (!(value >= 0.0 && value < static_cast<double>(contents_.vertices))) {
        return Fail("face " + std::to_string(row) + " has a vertex index outside of 0 to " +
                    std::to_string(contents_.vertices - 1));
      }
      const auto vertex = static_cast<uint32_t>(value) + static_cast<uint32_t>(first_vertex_);
      if (i == 0.0) {
        first = vertex;
      } else if (i >= 2.0) {
        arrays_.indices->insert(arrays_.indices->end(), {first, last, vertex});
      }
      last = vertex;
    }
    if (corners < 3.0) ++contents_.short_faces;
    return Done{};
  }

  PlyArrays arrays_;
  PlyContents& contents_;
  size_t first_vertex_;
};

}  // namespace swell

#endif  // SWELL_IMPORT_PLY_FACES_H_
