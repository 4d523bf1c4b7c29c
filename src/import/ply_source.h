// The values of a PLY file's body one after the other: a source for each encoding.
#ifndef SWELL_IMPORT_PLY_SOURCE_H_
#define SWELL_IMPORT_PLY_SOURCE_H_

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>

#include "src/import/ply_header.h"

namespace swell {

static_assert(std::endian::native == std::endian::little, "binary PLY is read as words");

template <class T> T LoadPlyWord(const char* bytes, bool swap) {
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

inline double LoadPlyScalar(const char* bytes, PlyScalar type, bool swap) {
  switch (type) {
    case PlyScalar::kInt8:
      return static_cast<double>(LoadPlyWord<int8_t>(bytes, swap));
    case PlyScalar::kUint8:
      return static_cast<double>(LoadPlyWord<uint8_t>(bytes, swap));
    case PlyScalar::kInt16:
      return static_cast<double>(LoadPlyWord<int16_t>(bytes, swap));
    case PlyScalar::kUint16:
      return static_cast<double>(LoadPlyWord<uint16_t>(bytes, swap));
    case PlyScalar::kInt32:
      return static_cast<double>(LoadPlyWord<int32_t>(bytes, swap));
    case PlyScalar::kUint32:
      return static_cast<double>(LoadPlyWord<uint32_t>(bytes, swap));
    case PlyScalar::kFloat:
      return static_cast<double>(LoadPlyWord<float>(bytes, swap));
    case PlyScalar::kDouble:
      return LoadPlyWord<double>(bytes, swap);
  }
  return 0.0;
}

// Next() returns false at the end of the data or for what is no number.
class PlyBinarySource {
 public:
  static constexpr uint64_t kSlackBytes = 0;
  PlyBinarySource(std::string_view data, size_t offset, bool swap)
      : data_(data), at_(offset), swap_(swap) {}

  bool Next(PlyScalar type, double* value) {
    const size_t size = PlySizeOf(type);
    if (remaining() < size) return false;
    *value = LoadPlyScalar(data_.data() + at_, type, swap_);
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

class PlyAsciiSource {
 public:
  static constexpr uint64_t kSlackBytes = 1;  // the last value needs no space behind it
  PlyAsciiSource(std::string_view data, size_t offset, uint32_t line)
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

}  // namespace swell

#endif  // SWELL_IMPORT_PLY_SOURCE_H_
