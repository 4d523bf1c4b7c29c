// The bodies of PLY files: one source of values per encoding, and direct paths for the layouts that
// large binary meshes have. Every count is checked against the file's size first.
#include "src/import/ply.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <string_view>
#include <type_traits>

#include "src/import/file_bytes.h"
#include "src/import/ply_header.h"

namespace swell {
namespace {

static_assert(std::endian::native == std::endian::little, "binary PLY is read as words");

// Positions are gathered by 3 * vertex in signed 32-bit arithmetic.
constexpr uint64_t kMaxVertices = 0x7FFFFFFFu / 3;
constexpr uint64_t kMaxIndices = 0x7FFFFFFFu;

template <class T> T LoadWord(const char* bytes, bool swap) {
  T value;
  if (!swap) {
    std::memcpy(&value, bytes, sizeof(T));
    return value;
  }
  char reversed[sizeof(T)];
  std::reverse_copy(bytes, bytes + sizeof(T), reversed);
  std::memcpy(&value, reversed, sizeof(T));
  return value;
}

double LoadScalar(const char* bytes, PlyScalar type, bool swap) {
  switch (type) {
    case PlyScalar::kInt8:
      return static_cast<double>(LoadWord<int8_t>(bytes, swap));
    case PlyScalar::kUint8:
      return static_cast<double>(LoadWord<uint8_t>(bytes, swap));
    case PlyScalar::kInt16:
      return static_cast<double>(LoadWord<int16_t>(bytes, swap));
    case PlyScalar::kUint16:
      return static_cast<double>(LoadWord<uint16_t>(bytes, swap));
    case PlyScalar::kInt32:
      return static_cast<double>(LoadWord<int32_t>(bytes, swap));
    case PlyScalar::kUint32:
      return static_cast<double>(LoadWord<uint32_t>(bytes, swap));
    case PlyScalar::kFloat:
      return static_cast<double>(LoadWord<float>(bytes, swap));
    case PlyScalar::kDouble:
      return LoadWord<double>(bytes, swap);
  }
  return 0.0;
}

// Values one after the other. Next() returns false at the end of the data or for what is no number.
class BinarySource {
 public:
  static constexpr uint64_t kSlackBytes = 0;
  BinarySource(std::string_view data, size_t offset, bool swap)
      : data_(data), at_(offset), swap_(swap) {}

  bool Next(PlyScalar type, double* value) {
    const size_t size = PlySizeOf(type);
    if (remaining() < size) return false;
    *value = LoadScalar(data_.data() + at_, type, swap_);
    at_ += size;
    return true;
  }
  uint64_t remaining() const { return data_.size() - at_; }
  // The least bytes that `values` and `lists` of an element's row can take.
  static uint64_t MinBytes(const PlyElement& element) {
    uint64_t bytes = 0;
    for (const PlyProperty& p : element.properties)
      bytes += PlySizeOf(p.count_type.value_or(p.type));
    return bytes;
  }
  static uint64_t MinListBytes(const PlyProperty& list, uint64_t values) {
    return values * PlySizeOf(list.type);
  }
  std::string Where() const { return "byte " + std::to_string(at_); }
  const char* bytes() const { return data_.data() + at_; }
  void Skip(size_t size) { at_ += size; }
  bool swap() const { return swap_; }

 private:
  std::string_view data_;
  size_t at_;
  bool swap_;
};

class AsciiSource {
 public:
  static constexpr uint64_t kSlackBytes = 1;  // the last value needs no space behind it
  AsciiSource(std::string_view data, size_t offset, uint32_t line)
      : at_(data.data() + offset), end_(data.data() + data.size()), line_(line) {}

  bool Next(PlyScalar, double* value) {
    while (at_ < end_ && (*at_ == ' ' || *at_ == '\n' || *at_ == '\r' || *at_ == '\t')) {
      line_ += *at_ == '\n' ? 1 : 0;
      ++at_;
    }
    if (at_ < end_ && *at_ == '+') ++at_;
    const auto [end, status] = std::from_chars(at_, end_, *value);
    if (status == std::errc::invalid_argument) return false;
    if (status == std::errc::result_out_of_range) {  // overflow or underflow: the exponent tells
      const std::string_view text(at_, static_cast<size_t>(end - at_));
      const size_t exponent = text.find_first_of("eE");
      const bool tiny = exponent != std::string_view::npos && exponent + 1 < text.size() &&
                        text[exponent + 1] == '-';
      *value = tiny ? 0.0 : std::numeric_limits<double>::infinity();
    }
    at_ = end;
    return true;
  }
  uint64_t remaining() const { return static_cast<uint64_t>(end_ - at_); }
  // A value is at least one digit and the space behind it.
  static uint64_t MinBytes(const PlyElement& element) { return 2 * element.properties.size(); }
  static uint64_t MinListBytes(const PlyProperty&, uint64_t values) { return 2 * values; }
  std::string Where() const { return "line " + std::to_string(line_); }

 private:
  const char* at_;
  const char* end_;
  uint32_t line_;
};

template <class Source> class BodyReader {
 public:
  BodyReader(Source source, const PlyArrays& arrays)
      : source_(source), arrays_(arrays), first_vertex_(arrays.positions->size() / 3) {}

  Result<PlyContents> Read(const PlyHeader& header) {
    for (const PlyElement& element : header.elements) {
      if (Status fits = CheckCount(element); !fits) return fits.error();
      Status status = Done{};
      if (element.name == "vertex") {
        status = ReadVertices(element);
      } else if (element.name == "face") {
        status = ReadFaces(element);
      } else if (element.name == "tristrips") {
        status = PlyErrorAt(element.line, "'tristrips' are not supported; save the mesh as faces");
      } else {
        status = SkipElement(element);
      }
      if (!status) return status.error();
    }
    contents_.triangles = (arrays_.indices->size() - first_index_) / 3;
    return contents_;
  }

 private:
  Error Fail(const std::string& what) const {
    return Error{": " + what + " at " + source_.Where()};
  }
  Error Truncated(const PlyElement& element, uint64_t row) const {
    return Fail("the file ends or has no number in " + std::string(element.name) + " " +
                std::to_string(row) + " of " + std::to_string(element.count));
  }

  Status CheckCount(const PlyElement& element) const {
    const uint64_t row = Source::MinBytes(element);
    if (row > 0 && element.count > (source_.remaining() + Source::kSlackBytes) / row) {
      return PlyErrorAt(element.line, std::to_string(element.count) + " " +
                                          std::string(element.name) + " rows do not fit the " +
                                          std::to_string(source_.remaining()) +
                                          " bytes left in the file");
    }
    return Done{};
  }

  Status SkipElement(const PlyElement& element) {
    if (element.properties.empty()) return Done{};
    for (uint64_t row = 0; row < element.count; ++row) {
      for (const PlyProperty& property : element.properties) {
        if (!SkipProperty(property)) return Truncated(element, row);
      }
    }
    return Done{};
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

  Status ReadVertices(const PlyElement& element) {
    if (element.count + first_vertex_ > kMaxVertices) {
      return PlyErrorAt(element.line,
                        "more than " + std::to_string(kMaxVertices) + " vertices in the scene");
    }
    const std::vector<Target> targets = BindVertices(element);
    if (targets.empty()) {
      return PlyErrorAt(element.line, "vertices have no x, y and z");
    }
    contents_.vertices = static_cast<uint32_t>(element.count);
    if constexpr (std::is_same_v<Source, BinarySource>) {
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
        out[row * out_stride] = LoadWord<float>(in + row * row_bytes, false);
      }
      return;
    }
    for (size_t row = 0; row < count; ++row) {
      out[row * out_stride] = static_cast<float>(LoadScalar(in + row * row_bytes, type, swap));
    }
  }

  // Faces of the usual layout (uchar 3, three 32-bit indices) from row `row` on, as long as they
  // are triangles with valid indices. Returns the first row that needs the general reader.
  uint64_t ReadPlainTriangles(uint64_t row, uint64_t count) {
    constexpr size_t kRowBytes = 1 + 3 * sizeof(uint32_t);
    const char* in = source_.bytes();
    const uint64_t available = std::min(count - row, source_.remaining() / kRowBytes);
    const size_t out = arrays_.indices->size();
    if (out + 3 * available > kMaxIndices) return row;
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

  Status ReadFaces(const PlyElement& element) {
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
    first_index_ = arrays_.indices->size();
    arrays_.indices->reserve(first_index_ + static_cast<size_t>(3 * likely));
    uint64_t row = 0;
    if constexpr (std::is_same_v<Source, BinarySource>) {
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
      if (arrays_.indices->size() > kMaxIndices) {
        return Fail("more than " + std::to_string(kMaxIndices / 3) + " triangles in the scene");
      }
    }
    return Done{};
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

  Source source_;
  PlyArrays arrays_;
  size_t first_vertex_;
  size_t first_index_ = 0;
  PlyContents contents_;
};

}  // namespace

Result<PlyContents> ReadPly(const std::string& path, const PlyArrays& arrays) {
  const Result<FileBytes> file = FileBytes::Map(path);
  if (!file) return Error{path + ": " + file.error().message};
  const std::string_view data = file->bytes();
  Result<PlyHeader> header = ReadPlyHeader(data);
  if (!header) return Error{path + header.error().message};

  const auto has = [&](std::string_view name) {
    return std::any_of(header->elements.begin(), header->elements.end(),
                       [&](const PlyElement& e) { return e.name == name && e.count > 0; });
  };
  for (std::string_view name : {"vertex", "face"}) {
    if (!has(name)) return Error{path + ": has no element '" + std::string(name) + "'"};
  }
  Result<PlyContents> contents =
      header->encoding == PlyEncoding::kAscii
          ? BodyReader(AsciiSource(data, header->size, header->lines + 1), arrays).Read(*header)
          : BodyReader(BinarySource(data, header->size, header->encoding == PlyEncoding::kBig),
                       arrays)
                .Read(*header);
  if (!contents) return Error{path + contents.error().message};
  return contents;
}

}  // namespace swell
