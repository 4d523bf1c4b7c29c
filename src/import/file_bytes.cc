// Maps files, unpacks those of gzip, and says in words why a file cannot be read.
#include "src/import/file_bytes.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "src/base/available_memory.h"
#include "src/import/gunzip.h"

namespace swell {

Result<FileBytes> FileBytes::Map(const std::string& path) {
  // O_NONBLOCK: opening a pipe without a writer must not wait.
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) {
    if (errno == ENOENT || errno == ENOTDIR) return Error{"does not exist"};
    return Error{std::string("cannot be opened: ") + std::strerror(errno)};
  }
  struct stat info {};
  if (fstat(file, &info) != 0 || !S_ISREG(info.st_mode)) {
    close(file);
    return Error{S_ISDIR(info.st_mode) ? "is a directory, not a file" : "is not a regular file"};
  }
  if (info.st_size == 0) {
    close(file);
    return Error{"is empty"};
  }
  const auto size = static_cast<size_t>(info.st_size);
  void* memory = mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file, 0);
  const int map_errno = errno;
  close(file);
  if (memory == MAP_FAILED) {
    return Error{std::string("cannot be read: ") + std::strerror(map_errno)};
  }
  return FileBytes(std::string_view(static_cast<const char*>(memory), size));
}

Result<FileBytes> FileBytes::Read(const std::string& path, size_t max_unpacked_bytes) {
  Result<FileBytes> file = Map(path);
  if (!file || !IsGzip(file->bytes())) return file;
  const auto limit = static_cast<size_t>(std::min<uint64_t>(max_unpacked_bytes, AvailableMemory()));
  Result<std::string> unpacked = Gunzip(file->bytes(), limit);
  if (!unpacked) return unpacked.error();
  if (unpacked->empty()) return Error{"is empty"};
  return FileBytes(std::make_unique<std::string>(std::move(*unpacked)));
}

FileBytes::~FileBytes() {
  if (unpacked_ == nullptr && !bytes_.empty())
    munmap(const_cast<char*>(bytes_.data()), bytes_.size());
}

}  // namespace swell
