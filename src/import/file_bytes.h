// A path -> the bytes of the regular file behind it: mapped read-only, or unpacked by gzip.
#ifndef SWELL_IMPORT_FILE_BYTES_H_
#define SWELL_IMPORT_FILE_BYTES_H_

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "src/base/result.h"

namespace swell {

// A small file may unpack to a thousand times its size; what is larger than this or than the free
// memory is refused.
inline constexpr size_t kMaxUnpackedBytes = size_t{16} << 30;

class FileBytes {
 public:
  // Errors say what is wrong without naming the path: "is a directory", "does not exist", ...
  static Result<FileBytes> Map(const std::string& path);

  // As Map, but a file that starts like gzip's is unpacked, whatever its name.
  static Result<FileBytes> Read(const std::string& path,
                                size_t max_unpacked_bytes = kMaxUnpackedBytes);

  FileBytes(FileBytes&& other) noexcept
      : bytes_(std::exchange(other.bytes_, {})), unpacked_(std::move(other.unpacked_)) {}
  FileBytes& operator=(FileBytes&& other) noexcept {
    std::swap(bytes_, other.bytes_);
    std::swap(unpacked_, other.unpacked_);
    return *this;
  }
  ~FileBytes();

  std::string_view bytes() const { return bytes_; }

 private:
  explicit FileBytes(std::string_view bytes) : bytes_(bytes) {}
  explicit FileBytes(std::unique_ptr<std::string> unpacked)
      : bytes_(*unpacked), unpacked_(std::move(unpacked)) {}

  std::string_view bytes_;
  std::unique_ptr<std::string> unpacked_;  // null: bytes_ are mapped
};

}  // namespace swell

#endif  // SWELL_IMPORT_FILE_BYTES_H_
