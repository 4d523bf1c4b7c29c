// The vertices of a PLY file -> rows of positions, normals and texture coordinates, with a direct
// path for binary rows of a fixed size.
#ifndef SWELL_IMPORT_PLY_VERTICES_H_
#define SWELL_IMPORT_PLY_VERTICES_H_

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "src/import/ply.h"
#include "src/import/ply_header.h"
#include "src/import/ply_rows.h"
#include "src/import/ply_source.h"

namespace swell {

// Positions are gathered by 3 * vertex in signed 32-bit arithmetic.
inline constexpr uint64_t kMaxPlyVertices = 0x7FFFFFFFu / 3;

// Appends the vertices to the arrays.
template <class Source> class PlyVertices : private PlyRows<Source> {
 public:
  PlyVertices(Source& source, const PlyArrays& arrays, PlyContents* contents)
      : Rows(source),
        arrays_(arrays),
        contents_(*contents),
        first_vertex_(arrays.positions->size() / 3) {}

  Status Read(const PlyElement& element) {
    if (element.count + first_vertex_ > kMaxPlyVertices) {
      return PlyErrorAt(element.line,
                        "more than " + std::to_string(kMaxPlyVertices) + " vertices in the scene");
    }
    const std::vector<Target> targets = BindVertices(element);
    if (targets.empty()) {
      return PlyErrorAt(element.line, "vertices have no x, y and z");
    }
    contents_.vertices = static_cast<uint32_t>(element.count);
    if constexpr (std::is_same_v<Source, PlyBinarySource>) {
      const bool fixed =
          std::none_of(element.properties.begin(), element.properties.end(),
                       [](const PlyProperty& p) { return p.count_type.has_value(); });
      if (fixed) return CopyVertices(element, targets);
    }
    for (size_t row = 0; row < element.count; ++row) {
      for (size_t i = 0; i < targets.size(); ++i) {
        const Target& target = targets[i];
        if (target.array == nullptr) {
          if (!SkipProperty(element.properties[i])) return Truncated(element, row);
          continue;
        }
        double value = 0.0;
        if (!source_.Next(element.properties[i].type, &value)) return Truncated(element, row);
        const auto rounded = static_cast<float>(value);
        if (target.array == arrays_.positions && !std::isfinite(rounded)) {
          return Fail("vertex " + std::to_string(row) + " is not finite");
        }
        (*target.array)[target.first + target.stride * row + target.column] = rounded;
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

  // Where a property of the vertices goes; a null array drops it.
  struct Target {
    std::vector<float>* array = nullptr;
    size_t first = 0, stride = 0, column = 0;
  };

  // Grows the arrays by the vertices' rows and says which property goes where.
  std::vector<Target> BindVertices(const PlyElement& element) {
    const auto count = static_cast<size_t>(element.count);
    std::vector<Target> targets(element.properties.size());
    const auto bind = [&](std::vector<float>* array,
                          std::initializer_list<std::string_view> names) {
      for (std::string_view name : names) {
        if (!element.FindScalar(name)) return false;
      }
      const size_t first = array->size();
      size_t column = 0;
      for (std::string_view name : names) {
        targets[*element.FindScalar(name)] = {array, first, names.size(), column++};
      }
      array->resize(first + names.size() * count);
      return true;
    };
    if (!bind(arrays_.positions, {"x", "y", "z"})) return {};
    contents_.has_normals = bind(arrays_.normals, {"nx", "ny", "nz"});
    contents_.has_uvs = bind(arrays_.uvs, {"u", "v"}) || bind(arrays_.uvs, {"s", "t"}) ||
                        bind(arrays_.uvs, {"texture_u", "texture_v"}) ||
                        bind(arrays_.uvs, {"texture_s", "texture_t"});
    return targets;
  }

  // Vertices of a fixed size, property by property. CheckCount has seen that all rows are there.
  Status CopyVertices(const PlyElement& element, const std::vector<Target>& targets) {
    const auto row_bytes = static_cast<size_t>(Source::MinBytes(element));
    size_t offset = 0;
    for (size_t i = 0; i < targets.size(); ++i) {
      const PlyScalar type = element.properties[i].type;
      const Target& target = targets[i];
      if (target.array != nullptr) {
        float* out = target.array->data() + target.first + target.column;
        CopyColumn(source_.bytes() + offset, row_bytes, type, element.count, out, target.stride);
      }
      offset += PlySizeOf(type);
    }
    const std::vector<float>& positions = *arrays_.positions;
    for (size_t i = 3 * first_vertex_; i < positions.size(); ++i) {
      if (std::isfinite(positions[i])) continue;
      const size_t row = i / 3 - first_vertex_;
      source_.Skip(row_bytes * row);
      return Fail("vertex " + std::to_string(row) + " is not finite");
    }
    source_.Skip(row_bytes * element.count);
    return Done{};
  }

  // One property of all vertices.
  void CopyColumn(const char* in, size_t row_bytes, PlyScalar type, size_t count, float* out,
                  size_t out_stride) const {
    const bool swap = source_.swap();
    if (type == PlyScalar::kFloat && !swap) {
      for (size_t row = 0; row < count; ++row) {
        out[row * out_stride] = LoadPlyWord<float>(in + row * row_bytes, false);
      }
      return;
    }
    for (size_t row = 0; row < count; ++row) {
      out[row * out_stride] = static_cast<float>(LoadPlyScalar(in + row * row_bytes, type, swap));
    }
  }

  PlyArrays arrays_;
  PlyContents& contents_;
  size_t first_vertex_;
};

}  // namespace swell

#endif  // SWELL_IMPORT_PLY_VERTICES_H_
