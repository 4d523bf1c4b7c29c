// A file that appears under its name whole or not at all, on top of POSIX calls.
#ifndef SWELL_BASE_NEW_FILE_H_
#define SWELL_BASE_NEW_FILE_H_

#include <cstdint>
#include <cstdio>
#include <string>

#include "src/base/result.h"

namespace swell {

// Writes go to a hidden file in the folder of `path`; Commit gives it its name. Without a
// successful Commit the hidden file is removed again.
class NewFile {
 public:
  // An error if `path` cannot become a regular file: its folder is missing or read-only, it is a
  // folder or a device itself, or a file that may not be written.
  static Result<NewFile> Open(const std::string& path);

  NewFile(NewFile&& other) noexcept;
  NewFile& operator=(NewFile&&) = delete;
  ~NewFile();

  // After the first failure, writes do nothing; Commit reports it.
  void Write(const void* bytes, size_t count);
  void Seek(int64_t position);
  int64_t position() const { return position_; }
  int64_t size() const { return size_; }

  // Syncs the contents to the disk, checks their size, closes, renames, and syncs the folder.
  Status Commit();

 private:
  NewFile() = default;
  void Fail(int reason);
  void Discard();

  std::string path_;         // as the caller named it, for messages
  std::string target_;       // path_ with its links followed
  std::string hidden_path_;  // "" once there is no such file
  std::FILE* file_ = nullptr;
  int64_t position_ = 0, size_ = 0;
  int failure_ = 0;  // errno of the first failure
};

}  // namespace swell

#endif  // SWELL_BASE_NEW_FILE_H_
