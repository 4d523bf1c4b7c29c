// A path -> the bytes of the regular file behind it, mapped read-only.
#ifndef SWELL_IMPORT_FILE_BYTES_H_
#define SWELL_IMPORT_FILE_BYTES_H_

#include <string>
#include <string_view>
#include <utility>

#include "src/base/result.h"

namespace swell {

class FileBytes {
 public:
  // Errors say what is wrong without naming the path: "is a directory", "does not exist", ...
  static Result<FileBytes> Map(const std::string& path);

  FileBytes(FileBytes&& other) noexcept : bytes_(std::exchange(other.bytes_, {})) {}
  FileBytes& operator=(FileBytes&& other) noexcept {
    std::swap(bytes_, other.bytes_);
    return *this;
  }
  ~FileBytes();

  std::string_view bytes() const { return bytes_; }

 private:
  explicit FileBytes(std::string_view bytes) : bytes_(bytes) {}
  std::string_view bytes_;
};

}  // namespace swell

#endif  // SWELL_IMPORT_FILE_BYTES_H_
