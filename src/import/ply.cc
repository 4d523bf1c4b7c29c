// The PLY reader: a header parser, one source of values per encoding, and direct paths for the
// layouts that large binary meshes have. Every count is checked against the file's size first.
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

#include "src/import/diagnostics.h"
#include "src/import/file_bytes.h"
#include "src/import/suggest.h"

namespace swell {
namespace {

static_assert(std::endian::native == std::endian::little, "binary PLY is read as words");

// Positions are gathered by 3 * vertex in signed 32-bit arithmetic.
constexpr uint64_t kMaxVertices = 0x7FFFFFFFu / 3;
constexpr uint64_t kMaxIndices = 0x7FFFFFFFu;

enum class Scalar { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

struct ScalarName {
  std::string_view name;
  Scalar type;
};
constexpr ScalarName kScalarNames[] = {
    {"char", Scalar::kInt8},     {"int8", Scalar::kInt8},     {"uchar", Scalar::kUint8},
    {"uint8", Scalar::kUint8},   {"short", Scalar::kInt16},   {"int16", Scalar::kInt16},
    {"ushort", Scalar::kUint16}, {"uint16", Scalar::kUint16}, {"int", Scalar::kInt32},
    {"int32", Scalar::kInt32},   {"uint", Scalar::kUint32},   {"uint32", Scalar::kUint32},
    {"float", Scalar::kFloat},   {"float32", Scalar::kFloat}, {"double", Scalar::kDouble},
    {"float64", Scalar::kDouble}};

size_t SizeOf(Scalar type) {
  constexpr size_t kSizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<size_t>(type)];
}

struct Property {
  std::string_view name;
  Scalar type = Scalar::kFloat;
  std::optional<Scalar> count_type;  // of lists
};

struct Element {
  std::string_view name;
  uint64_t count = 0;
  uint32_t line = 0;
  std::vector<Property> properties;

  std::optional<size_t> FindScalar(std::string_view property) const {
    for (size_t i = 0; i < properties.size(); ++i) {
      if (properties[i].name == property && !properties[i].count_type) return i;
    }
    return std::nullopt;
  }
  std::optional<size_t> FindIndices() const {
    for (size_t i = 0; i < properties.size(); ++i) {
      const Property& p = properties[i];
      if ((p.name == "vertex_indices" || p.name == "vertex_index") && p.count_type) return i;
    }
    return std::nullopt;
  }
};

enum class Encoding { kAscii, kLittle, kBig };

struct Header {
  Encoding encoding = Encoding::kAscii;
  std::vector<Element> elements;
  size_t size = 0;  // bytes up to the first value
  uint32_t lines = 0;
};

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

double LoadScalar(const char* bytes, Scalar type, bool swap) {
  switch (type) {
    case Scalar::kInt8:
      return static_cast<double>(LoadWord<int8_t>(bytes, swap));
    case Scalar::kUint8:
      return static_cast<double>(LoadWord<uint8_t>(bytes, swap));
    case Scalar::kInt16:
      return static_cast<double>(LoadWord<int16_t>(bytes, swap));
    case Scalar::kUint16:
      return static_cast<double>(LoadWord<uint16_t>(bytes, swap));
    case Scalar::kInt32:
      return static_cast<double>(LoadWord<int32_t>(bytes, swap));
    case Scalar::kUint32:
      return static_cast<double>(LoadWord<uint32_t>(bytes, swap));
    case Scalar::kFloat:
      return static_cast<double>(LoadWord<float>(bytes, swap));
    case Scalar::kDouble:
      return LoadWord<double>(bytes, swap);
  }
  return 0.0;
}

// Values one after the other. Next() returns false at the end of the data or for what is no number.
class BinarySource {
 public:
  BinarySource(std::string_view data, size_t offset, bool swap)
      : data_(data), at_(offset), swap_(swap) {}

  bool Next(Scalar type, double* value) {
    const size_t size = SizeOf(type);
    if (remaining() < size) return false;
    *value = LoadScalar(data_.data() + at_, type, swap_);
    at_ += size;
    return true;
  }
  uint64_t remaining() const { return data_.size() - at_; }
  // The least bytes that `values` and `lists` of an element's row can take.
  static uint64_t MinBytes(const Element& element) {
    uint64_t bytes = 0;
    for (const Property& p : element.properties) bytes += SizeOf(p.count_type.value_or(p.type));
    return bytes;
  }
  static uint64_t MinListBytes(const Property& list, uint64_t values) {
    return values * SizeOf(list.type);
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
  AsciiSource(std::string_view data, size_t offset, uint32_t line)
      : at_(data.data() + offset), end_(data.data() + data.size()), line_(line) {}

  bool Next(Scalar, double* value) {
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
  // A value is at least one digit and the space before it.
  static uint64_t MinBytes(const Element& element) { return 2 * element.properties.size(); }
  static uint64_t MinListBytes(const Property&, uint64_t values) { return 2 * values; }
  std::string Where() const { return "line " + std::to_string(line_); }

 private:
  const char* at_;
  const char* end_;
  uint32_t line_;
};

// ---------------------------------------------------------------- header
class HeaderReader {
 public:
  explicit HeaderReader(std::string_view data) : data_(data) {}

  Result<Header> Read() {
    if (data_.substr(0, 2) == "\x1F\x8B") return Error{": is compressed; unpack it with gunzip"};
    std::vector<std::string_view> words = NextLine();
    if (words.size() != 1 || words[0] != "ply") {
      return Error{": is no PLY file (its first line is not 'ply')"};
    }
    bool has_format = false;
    while (at_ < data_.size()) {
      words = NextLine();
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "end_header") {
        if (!has_format) return Fail("'format' is missing");
        header_.size = at_;
        header_.lines = line_;
        return std::move(header_);
      }
      Status status = Done{};
      if (words[0] == "format") {
        has_format = true;
        status = ReadFormat(words);
      } else if (words[0] == "element") {
        status = ReadElement(words);
      } else if (words[0] == "property") {
        status = ReadProperty(words);
      } else {
        status = Fail("unknown header line " + Quote(words[0]) +
                      DidYouMean(words[0], {"format", "element", "property", "comment", "obj_info",
                                            "end_header"}));
      }
      if (!status) return status.error();
    }
    return Error{": the header has no 'end_header'"};
  }

 private:
  std::vector<std::string_view> NextLine() {
    const size_t end = std::min(data_.find('\n', at_), data_.size());
    std::string_view line = data_.substr(at_, end - at_);
    at_ = std::min(end + 1, data_.size());
    ++line_;
    std::vector<std::string_view> words;
    for (size_t i = 0; i < line.size();) {
      const size_t first = line.find_first_not_of(" \t\r", i);
      if (first == std::string_view::npos) break;
      const size_t last = std::min(line.find_first_of(" \t\r", first), line.size());
      words.push_back(line.substr(first, last - first));
      i = last;
    }
    return words;
  }

  Error Fail(const std::string& what) const {
    return Error{":" + std::to_string(line_) + ": " + what};
  }

  Status ReadFormat(const std::vector<std::string_view>& words) {
    const std::string_view name = words.size() >= 2 ? words[1] : "";
    if (name == "ascii") {
      header_.encoding = Encoding::kAscii;
    } else if (name == "binary_little_endian") {
      header_.encoding = Encoding::kLittle;
    } else if (name == "binary_big_endian") {
      header_.encoding = Encoding::kBig;
    } else {
      return Fail("unknown format " + Quote(name) +
                  "; ascii, binary_little_endian and binary_big_endian exist");
    }
    return Done{};
  }

  Status ReadElement(const std::vector<std::string_view>& words) {
    Element element;
    element.line = line_;
    if (words.size() == 3) {
      element.name = words[1];
      const auto [end, status] =
          std::from_chars(words[2].data(), words[2].data() + words[2].size(), element.count);
      if (status == std::errc() && end == words[2].data() + words[2].size()) {
        for (const Element& other : header_.elements) {
          if (other.name == element.name)
            return Fail("element " + Quote(words[1]) + " is given twice");
        }
        header_.elements.push_back(element);
        return Done{};
      }
    }
    return Fail("'element NAME COUNT' is expected");
  }

  Status ReadProperty(const std::vector<std::string_view>& words) {
    if (header_.elements.empty()) return Fail("a property comes before the first element");
    Property property;
    const bool list = words.size() == 5 && words[1] == "list";
    if (!list && words.size() != 3) {
      return Fail("'property TYPE NAME' or 'property list TYPE TYPE NAME' is expected");
    }
    property.name = words.back();
    const auto type = FindType(words[words.size() - 2]);
    if (!type) return Fail("unknown property type " + Quote(words[words.size() - 2]));
    property.type = *type;
    if (list) {
      property.count_type = FindType(words[2]);
      if (!property.count_type || *property.count_type >= Scalar::kFloat) {
        return Fail("the count of a list must be of an integer type, not " + Quote(words[2]));
      }
    }
    header_.elements.back().properties.push_back(property);
    return Done{};
  }

  static std::optional<Scalar> FindType(std::string_view name) {
    for (const ScalarName& scalar : kScalarNames) {
      if (scalar.name == name) return scalar.type;
    }
    return std::nullopt;
  }

  std::string_view data_;
  size_t at_ = 0;
  uint32_t line_ = 0;
  Header header_;
};

// ---------------------------------------------------------------- body
template <class Source> class BodyReader {
 public:
  BodyReader(Source source, const PlyArrays& arrays)
      : source_(source), arrays_(arrays), first_vertex_(arrays.positions->size() / 3) {}

  Result<PlyContents> Read(const Header& header) {
    for (const Element& element : header.elements) {
      if (Status fits = CheckCount(element); !fits) return fits.error();
      Status status = Done{};
      if (element.name == "vertex") {
        status = ReadVertices(element);
      } else if (element.name == "face") {
        status = ReadFaces(element);
      } else if (element.name == "tristrips") {
        status = Error{":" + std::to_string(element.line) +
                       ": 'tristrips' are not supported; save the mesh as faces"};
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
  Error Truncated(const Element& element, uint64_t row) const {
    return Fail("the file ends or has no number in " + std::string(element.name) + " " +
                std::to_string(row) + " of " + std::to_string(element.count));
  }

  Status CheckCount(const Element& element) const {
    const uint64_t row = Source::MinBytes(element);
    // The last ASCII value needs no space after it, and the first none before.
    if (row > 0 && element.count > (source_.remaining() + 1) / row) {
      return Error{":" + std::to_string(element.line) + ": " + std::to_string(element.count) + " " +
                   std::string(element.name) + " rows do not fit the " +
                   std::to_string(source_.remaining()) + " bytes left in the file"};
    }
    return Done{};
  }

  Status SkipElement(const Element& element) {
    if (element.properties.empty()) return Done{};
    for (uint64_t row = 0; row < element.count; ++row) {
      for (const Property& property : element.properties) {
        if (!SkipProperty(property)) return Truncated(element, row);
      }
    }
    return Done{};
  }

  bool SkipProperty(const Property& property) {
    double value = 0.0;
    if (!property.count_type) return source_.Next(property.type, &value);
    double count = 0.0;
    if (!source_.Next(*property.count_type, &count) || !(count >= 0.0)) return false;
    for (double i = 0.0; i < count; i += 1.0) {
      if (!source_.Next(property.type, &value)) return false;
    }
    return true;
  }

  Status ReadVertices(const Element& element) {
    // Where property i of a row goes; null to drop it.
    struct Target {
      std::vector<float>* array;
      size_t first, stride, column;
    };
    const auto x = element.FindScalar("x"), y = element.FindScalar("y"),
               z = element.FindScalar("z");
    if (!x || !y || !z) {
      return Error{":" + std::to_string(element.line) + ": vertices have no x, y and z"};
    }
    if (element.count + first_vertex_ > kMaxVertices) {
      return Error{":" + std::to_string(element.line) + ": more than " +
                   std::to_string(kMaxVertices) + " vertices in the scene"};
    }
    const size_t count = static_cast<size_t>(element.count);
    std::vector<Target> targets(element.properties.size(), Target{nullptr, 0, 0, 0});
    const auto bind = [&](std::vector<float>* array, std::initializer_list<size_t> columns) {
      const size_t first = array->size();
      size_t column = 0;
      for (size_t i : columns) targets[i] = {array, first, columns.size(), column++};
      array->resize(first + columns.size() * count);
    };
    bind(arrays_.positions, {*x, *y, *z});
    const auto nx = element.FindScalar("nx"), ny = element.FindScalar("ny"),
               nz = element.FindScalar("nz");
    contents_.has_normals = nx && ny && nz;
    if (contents_.has_normals) bind(arrays_.normals, {*nx, *ny, *nz});
    constexpr std::string_view kUvNames[][2] = {
        {"u", "v"}, {"s", "t"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}};
    for (const auto& names : kUvNames) {
      const auto u = element.FindScalar(names[0]), v = element.FindScalar(names[1]);
      if (!u || !v) continue;
      bind(arrays_.uvs, {*u, *v});
      contents_.has_uvs = true;
      break;
    }
    contents_.vertices = static_cast<uint32_t>(count);

    if constexpr (std::is_same_v<Source, BinarySource>) {
      const bool fixed = std::none_of(element.properties.begin(), element.properties.end(),
                                      [](const Property& p) { return p.count_type.has_value(); });
      if (fixed) {  // CheckCount has seen that all rows are there
        size_t offset = 0;
        const size_t row_bytes = static_cast<size_t>(Source::MinBytes(element));
        for (size_t i = 0; i < targets.size(); ++i) {
          const Scalar type = element.properties[i].type;
          const Target& target = targets[i];
          if (target.array != nullptr) {
            float* out = target.array->data() + target.first + target.column;
            const char* in = source_.bytes() + offset;
            CopyColumn(in, row_bytes, type, count, out, target.stride);
          }
          offset += SizeOf(type);
        }
        const std::vector<float>& positions = *arrays_.positions;
        for (size_t i = 3 * first_vertex_; i < positions.size(); ++i) {
          if (std::isfinite(positions[i])) continue;
          source_.Skip(row_bytes * (i / 3 - first_vertex_));
          return Fail("vertex " + std::to_string(i / 3 - first_vertex_) + " is not finite");
        }
        source_.Skip(row_bytes * count);
        return Done{};
      }
    }
    for (size_t row = 0; row < count; ++row) {
      for (size_t i = 0; i < targets.size(); ++i) {
        const Target& target = targets[i];
        if (target.array == nullptr || element.properties[i].count_type) {
          if (!SkipProperty(element.properties[i])) return Truncated(element, row);
          continue;
        }
        double value = 0.0;
        if (!source_.Next(element.properties[i].type, &value)) return Truncated(element, row);
        const float rounded = static_cast<float>(value);
        if (target.array == arrays_.positions && !std::isfinite(rounded)) {
          return Fail("vertex " + std::to_string(row) + " is not finite");
        }
        (*target.array)[target.first + target.stride * row + target.column] = rounded;
      }
    }
    return Done{};
  }

  // One property of all vertices.
  void CopyColumn(const char* in, size_t row_bytes, Scalar type, size_t count, float* out,
                  size_t out_stride) const {
    const bool swap = source_.swap();
    if (type == Scalar::kFloat && !swap) {
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

  Status ReadFaces(const Element& element) {
    const auto list = element.FindIndices();
    if (!list) {
      return Error{":" + std::to_string(element.line) + ": faces have no list 'vertex_indices'"};
    }
    if (contents_.vertices == 0) {
      return Error{":" + std::to_string(element.line) + ": faces come before their vertices"};
    }
    const Property& indices = element.properties[*list];
    const uint64_t triangle_bytes = Source::MinBytes(element) + Source::MinListBytes(indices, 3);
    const uint64_t likely = std::min(element.count, source_.remaining() / triangle_bytes + 1);
    first_index_ = arrays_.indices->size();
    arrays_.indices->reserve(first_index_ + static_cast<size_t>(3 * likely));
    uint64_t row = 0;
    if constexpr (std::is_same_v<Source, BinarySource>) {
      if (!source_.swap() && element.properties.size() == 1 &&
          *indices.count_type == Scalar::kUint8 &&
          (indices.type == Scalar::kInt32 || indices.type == Scalar::kUint32)) {
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

  Status ReadFace(const Element& element, const Property& list, uint64_t row) {
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
  Result<Header> header = HeaderReader(data).Read();
  if (!header) return Error{path + header.error().message};

  const auto has = [&](std::string_view name) {
    return std::any_of(header->elements.begin(), header->elements.end(),
                       [&](const Element& e) { return e.name == name && e.count > 0; });
  };
  for (std::string_view name : {"vertex", "face"}) {
    if (!has(name)) return Error{path + ": has no element '" + std::string(name) + "'"};
  }
  Result<PlyContents> contents =
      header->encoding == Encoding::kAscii
          ? BodyReader(AsciiSource(data, header->size, header->lines + 1), arrays).Read(*header)
          : BodyReader(BinarySource(data, header->size, header->encoding == Encoding::kBig), arrays)
                .Read(*header);
  if (!contents) return Error{path + contents.error().message};
  return contents;
}

}  // namespace swell
