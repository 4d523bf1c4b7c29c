// Parses PLY headers line by line.
#include "src/import/ply_header.h"

#include <algorithm>
#include <charconv>
#include <string>

#include "src/import/diagnostics.h"
#include "src/base/suggest.h"

namespace swell {
namespace {

struct ScalarName {
  std::string_view name;
  PlyScalar type;
};
constexpr ScalarName kScalarNames[] = {
    {"char", PlyScalar::kInt8},     {"int8", PlyScalar::kInt8},     {"uchar", PlyScalar::kUint8},
    {"uint8", PlyScalar::kUint8},   {"short", PlyScalar::kInt16},   {"int16", PlyScalar::kInt16},
    {"ushort", PlyScalar::kUint16}, {"uint16", PlyScalar::kUint16}, {"int", PlyScalar::kInt32},
    {"int32", PlyScalar::kInt32},   {"uint", PlyScalar::kUint32},   {"uint32", PlyScalar::kUint32},
    {"float", PlyScalar::kFloat},   {"float32", PlyScalar::kFloat}, {"double", PlyScalar::kDouble},
    {"float64", PlyScalar::kDouble}};

class HeaderReader {
 public:
  explicit HeaderReader(std::string_view data) : data_(data) {}

  Result<PlyHeader> Read() {
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

  Error Fail(const std::string& what) const { return PlyErrorAt(line_, what); }

  Status ReadFormat(const std::vector<std::string_view>& words) {
    const std::string_view name = words.size() >= 2 ? words[1] : "";
    if (name == "ascii") {
      header_.encoding = PlyEncoding::kAscii;
    } else if (name == "binary_little_endian") {
      header_.encoding = PlyEncoding::kLittle;
    } else if (name == "binary_big_endian") {
      header_.encoding = PlyEncoding::kBig;
    } else {
      return Fail("unknown format " + Quote(name) +
                  "; ascii, binary_little_endian and binary_big_endian exist");
    }
    return Done{};
  }

  Status ReadElement(const std::vector<std::string_view>& words) {
    PlyElement element;
    element.line = line_;
    if (words.size() == 3) {
      element.name = words[1];
      const auto [end, status] =
          std::from_chars(words[2].data(), words[2].data() + words[2].size(), element.count);
      if (status == std::errc() && end == words[2].data() + words[2].size()) {
        for (const PlyElement& other : header_.elements) {
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
    PlyProperty property;
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
      if (!property.count_type || *property.count_type >= PlyScalar::kFloat) {
        return Fail("the count of a list must be of an integer type, not " + Quote(words[2]));
      }
    }
    header_.elements.back().properties.push_back(property);
    return Done{};
  }

  static std::optional<PlyScalar> FindType(std::string_view name) {
    for (const ScalarName& scalar : kScalarNames) {
      if (scalar.name == name) return scalar.type;
    }
    return std::nullopt;
  }

  std::string_view data_;
  size_t at_ = 0;
  uint32_t line_ = 0;
  PlyHeader header_;
};

}  // namespace

std::optional<size_t> PlyElement::FindScalar(std::string_view property) const {
  for (size_t i = 0; i < properties.size(); ++i) {
    if (properties[i].name == property && !properties[i].count_type) return i;
  }
  return std::nullopt;
}

std::optional<size_t> PlyElement::FindIndices() const {
  for (size_t i = 0; i < properties.size(); ++i) {
    const PlyProperty& p = properties[i];
    if ((p.name == "vertex_indices" || p.name == "vertex_index") && p.count_type) return i;
  }
  return std::nullopt;
}

Error PlyErrorAt(uint32_t line, const std::string& what) {
  std::string message = ":";
  message += std::to_string(line);
  return Error{message + ": " + what};
}

Result<PlyHeader> ReadPlyHeader(std::string_view data) { return HeaderReader(data).Read(); }

}  // namespace swell
