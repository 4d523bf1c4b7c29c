// Unpacks gzip (RFC 1952), members one after the other, by zlib.
#include "src/import/gunzip.h"

#include <zlib.h>

#include <algorithm>
#include <limits>

namespace swell {
namespace {

constexpr size_t kFirstBytes = size_t{1} << 16;
constexpr int kGzipWindow = 15 + 16;  // zlib's largest window, with gzip's header

// zlib's counts have 32 bits.
uInt Clip(size_t bytes) {
  return static_cast<uInt>(std::min<size_t>(bytes, std::numeric_limits<uInt>::max() / 2));
}

// How large the last member says it is, modulo 2^32; a hint, as long as deflate can have made it.
size_t ExpectedBytes(std::string_view packed, size_t max_bytes) {
  constexpr size_t kBestRatio = 1032;
  if (packed.size() < 18) return kFirstBytes;
  size_t size = 0;
  for (size_t i = 1; i <= 4; ++i) {
    size = size << 8 | static_cast<unsigned char>(packed[packed.size() - i]);
  }
  return std::min({std::max(size + 1, kFirstBytes), packed.size() * kBestRatio, max_bytes + 1});
}

struct Inflater {
  z_stream stream{};
  bool ok = inflateInit2(&stream, kGzipWindow) == Z_OK;
  Inflater() = default;
  Inflater(const Inflater&) = delete;
  ~Inflater() { inflateEnd(&stream); }
};

}  // namespace

bool IsGzip(std::string_view bytes) { return bytes.substr(0, 2) == "\x1F\x8B"; }

Result<std::string> Gunzip(std::string_view packed, size_t max_bytes) {
  Inflater inflater;
  if (!inflater.ok) return Error{"cannot be unpacked: no memory"};
  z_stream& stream = inflater.stream;
  std::string out(ExpectedBytes(packed, max_bytes), '\0');
  size_t used = 0, made = 0;
  while (true) {
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data() + used));
    stream.avail_in = Clip(packed.size() - used);
    stream.next_out = reinterpret_cast<Bytef*>(out.data() + made);
    stream.avail_out = Clip(out.size() - made);
    const uInt in = stream.avail_in, space = stream.avail_out;
    const int status = inflate(&stream, Z_NO_FLUSH);
    used += in - stream.avail_in;
    made += space - stream.avail_out;
    if (made > max_bytes) {
      return Error{"unpacks to more than " + std::to_string(max_bytes) + " bytes"};
    }
    if (status == Z_STREAM_END) {
      if (!IsGzip(packed.substr(used))) break;
      inflateReset(&stream);
    } else if (status != Z_OK && status != Z_BUF_ERROR) {
      return Error{"is damaged: its compressed data is wrong after byte " + std::to_string(used)};
    } else if (used == packed.size() && stream.avail_out > 0) {
      return Error{"is cut short: its compressed data ends too early"};
    }
    if (made == out.size()) out.resize(std::min(2 * out.size(), max_bytes + 1));
  }
  out.resize(made);
  return out;
}

}  // namespace swell
