// What the readers of a scene's text files share: threads, and meshes and images that several of
// them may name, each read once.
#ifndef SWELL_IMPORT_SHARED_READS_H_
#define SWELL_IMPORT_SHARED_READS_H_

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include <tbb/task_group.h>

#include "src/import/read_image.h"
#include "src/import/shared_ply.h"

namespace swell {

// An image of textures. Named, then read by some thread, then used when all threads are done.
struct SharedImage {
  std::string path;
  ImageUse use = ImageUse::kColor;
  Encoding encoding;
  std::optional<Result<TexelImage>> image;  // nothing: there was not enough memory
  uint64_t not_finite = 0;                  // values that were; they are 0 now
  bool told = false;                        // what is wrong with it

  // Throws nothing.
  void Read();
};

// TBB orders what comes before `run` before the task, and the task before what comes after `wait`.
// Both are said again here, in words that the thread sanitizer understands: it does not see into
// TBB.
class HandOver {
 public:
  static void Give() { count_.fetch_add(1, std::memory_order_acq_rel); }
  static void Take() { count_.load(std::memory_order_acquire); }
  // TBB copies the pointer into its task after Give, so this read has a suppression.
  template <class T> static T* TakePointer(T* const& handed) {
    Take();
    return handed;
  }

 private:
  static inline std::atomic<uint64_t> count_{0};
};

class SharedReads {
 public:
  SharedReads() = default;
  SharedReads(const SharedReads&) = delete;
  ~SharedReads() { Wait(); }

  // By some thread, before Wait returns. Tasks may run others.
  template <class Task> void Run(Task task) {
    auto* handed = new Task(std::move(task));
    HandOver::Give();
    group_.run([handed] {
      {
        const std::unique_ptr<Task> owned(HandOver::TakePointer(handed));
        (*owned)();
      }
      HandOver::Give();
    });
  }
  void Wait() {
    group_.wait();
    HandOver::Take();
  }

  // These begin to be read when they are first named.
  std::shared_ptr<SharedPly> Ply(const std::string& path);
  std::shared_ptr<SharedImage> Image(const std::string& path, ImageUse use,
                                     const Encoding& encoding);

  // When nobody names any more of them: a mesh is forgotten with its last use.
  void ForgetPlys() { plys_.clear(); }

  // Text files that were opened.
  std::atomic<size_t>* opened() { return &opened_; }

 private:
  std::mutex mutex_;  // of the maps
  std::map<std::string, std::shared_ptr<SharedPly>> plys_;
  std::map<std::tuple<std::string, ImageUse, int, float>, std::shared_ptr<SharedImage>> images_;
  std::atomic<size_t> opened_{0};
  tbb::task_group group_;
};

}  // namespace swell

#endif  // SWELL_IMPORT_SHARED_READS_H_
