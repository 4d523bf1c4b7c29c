// Bytes in, a whole file under its name or one line of error out.
#include "src/base/new_file.h"

#include <errno.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace swell {
namespace {

Error Cannot(const std::string& path, int reason) {
  const char* remedy = "";
  if (reason == ENOSPC || reason == EDQUOT || reason == EFBIG) {
    remedy = "; free some space or write elsewhere";
  } else if (reason == EACCES || reason == EPERM || reason == EROFS) {
    remedy = "; change its permissions or write elsewhere";
  }
  return Error{path + ": cannot be written: " + std::strerror(reason) + remedy};
}

std::string FolderOf(const std::string& path) {
  const size_t slash = path.find_last_of('/');
  if (slash == std::string::npos) return ".";
  return slash == 0 ? "/" : path.substr(0, slash);
}

// Where a file named `path` would be: links are followed, so that they are not replaced.
Result<std::string> FindTarget(const std::string& path) {
  const std::string folder = FolderOf(path);
  struct stat status;
  if (path.empty() || path.back() == '/') return Error{"'" + path + "': is not a file name"};
  if (stat(folder.c_str(), &status) != 0) {
    if (errno != ENOENT) return Cannot(path, errno);
    return Error{path + ": cannot be written: there is no folder '" + folder + "'; make it first"};
  }
  if (!S_ISDIR(status.st_mode)) {
    return Error{path + ": cannot be written: '" + folder + "' is not a folder"};
  }
  if (lstat(path.c_str(), &status) != 0) {
    if (errno == ENOENT) return path;
    return Cannot(path, errno);
  }

  std::string target = path;
  if (S_ISLNK(status.st_mode)) {
    char* resolved = realpath(path.c_str(), nullptr);
    if (resolved == nullptr) {
      return Error{path + ": cannot be written: is a symbolic link to nothing; remove it first"};
    }
    target = resolved;
    std::free(resolved);
    if (stat(target.c_str(), &status) != 0) return Cannot(path, errno);
  }
  if (S_ISDIR(status.st_mode)) return Error{path + ": cannot be written: is a folder"};
  if (!S_ISREG(status.st_mode)) return Error{path + ": cannot be written: is not a regular file"};
  if (faccessat(AT_FDCWD, target.c_str(), W_OK, AT_EACCESS) != 0) return Cannot(path, errno);
  return target;
}

// Unique among the files that this process writes; not longer than most names, so that a target's
// name near the system's limit still works.
std::string HiddenPath(const std::string& folder) {
  static std::atomic<uint32_t> next{0};
  return folder + "/.swell-" + std::to_string(getpid()) + "-" + std::to_string(next++) + ".tmp";
}

}  // namespace

Result<NewFile> NewFile::Open(const std::string& path) {
  Result<std::string> target = FindTarget(path);
  if (!target) return target.error();

  NewFile file;
  file.path_ = path;
  file.target_ = *target;
  const std::string hidden_path = HiddenPath(FolderOf(*target));
  unlink(hidden_path.c_str());  // of a process of the same number that was killed
  const int descriptor = open(hidden_path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC,
                              S_IRUSR | S_IWUSR | S_IRGRP | S_IWGRP | S_IROTH | S_IWOTH);
  if (descriptor < 0) return Cannot(path, errno);
  file.hidden_path_ = hidden_path;
  file.file_ = fdopen(descriptor, "wb");
  if (file.file_ == nullptr) {
    const int reason = errno;
    close(descriptor);
    return Cannot(path, reason);
  }
  return file;
}

NewFile::NewFile(NewFile&& other) noexcept
    : path_(std::move(other.path_)),
      target_(std::move(other.target_)),
      hidden_path_(std::exchange(other.hidden_path_, "")),
      file_(std::exchange(other.file_, nullptr)),
      position_(other.position_),
      size_(other.size_),
      failure_(other.failure_) {}

NewFile::~NewFile() { Discard(); }

void NewFile::Fail(int reason) {
  if (failure_ == 0) failure_ = reason != 0 ? reason : EIO;
}

void NewFile::Discard() {
  if (file_ != nullptr) std::fclose(std::exchange(file_, nullptr));
  if (!hidden_path_.empty()) unlink(std::exchange(hidden_path_, "").c_str());
}

void NewFile::Write(const void* bytes, size_t count) {
  if (failure_ == 0 && std::fwrite(bytes, 1, count, file_) != count) Fail(errno);
  position_ += static_cast<int64_t>(count);
  size_ = std::max(size_, position_);
}

void NewFile::Seek(int64_t position) {
  // Seeking flushes the buffer, so it can find the disk full.
  if (failure_ == 0 && fseeko(file_, position, SEEK_SET) != 0) Fail(errno);
  position_ = position;
}

Status NewFile::Commit() {
  struct stat status = {};
  if (failure_ == 0 && std::fflush(file_) != 0) Fail(errno);
  if (failure_ == 0 && fsync(fileno(file_)) != 0) Fail(errno);
  if (failure_ == 0 && fstat(fileno(file_), &status) != 0) Fail(errno);
  if (failure_ == 0 && status.st_size != size_) Fail(EIO);
  if (std::fclose(std::exchange(file_, nullptr)) != 0) Fail(errno);
  if (failure_ == 0 && std::rename(hidden_path_.c_str(), target_.c_str()) != 0) Fail(errno);
  if (failure_ != 0) {
    Discard();
    return Cannot(path_, failure_);
  }
  hidden_path_.clear();

  // The name survives a power cut only once the folder is synced. Some file systems cannot do that;
  // the file is whole either way.
  const int folder = open(FolderOf(target_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder >= 0) {
    fsync(folder);
    close(folder);
  }
  return Done{};
}

}  // namespace swell
