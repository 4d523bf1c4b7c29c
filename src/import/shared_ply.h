// A PLY file that several shapes name -> its rows for each of them, read once.
#ifndef SWELL_IMPORT_SHARED_PLY_H_
#define SWELL_IMPORT_SHARED_PLY_H_

#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "src/import/ply.h"
#include "src/scene/scene.h"

namespace swell {

// Named by one thread, then read, then given to as many parts as have named it, by any threads.
class SharedPly {
 public:
  explicit SharedPly(std::string path) : path_(std::move(path)) {}

  const std::string& path() const { return path_; }
  void AddUse() { ++uses_; }
  // Of one that will not ask. Before any asks.
  void DropUse() { --uses_; }
  // Throws nothing; what fails is told by Give.
  void Read();
  // When it is read; 0 if it cannot be.
  uint64_t triangles() const { return contents_ && *contents_ ? (*contents_)->triangles : 0; }
  // Leaves the file's rows, in its own space, in an empty part. The last to ask gets the rows
  // themselves, so that a file with one use is never copied.
  Result<PlyContents> Give(Scene* part);

 private:
  std::string path_;
  uint64_t uses_ = 0;
  std::mutex mutex_;  // of what follows, while it is given
  Scene rows_;
  std::optional<Result<PlyContents>> contents_;  // nothing: there was not enough memory
};

}  // namespace swell

#endif  // SWELL_IMPORT_SHARED_PLY_H_
