// Readers tell how far they are in their files -> bytes opened and gone through, of all threads,
// for progress.
#ifndef SWELL_IMPORT_READ_METER_H_
#define SWELL_IMPORT_READ_METER_H_

#include <atomic>
#include <cstdint>
#include <utility>

namespace swell {

struct InputBytes {
  std::atomic<uint64_t> opened{0}, done{0};
};

// Of this process so far.
inline InputBytes& TheInputBytes() {
  static InputBytes bytes;
  return bytes;
}

// One file while it is read; at the end all of it is done.
class MeteredRead {
 public:
  MeteredRead() = default;
  explicit MeteredRead(uint64_t bytes) : bytes_(bytes) { TheInputBytes().opened += bytes; }
  MeteredRead(MeteredRead&& other) noexcept { *this = std::move(other); }
  MeteredRead& operator=(MeteredRead&& other) noexcept {
    std::swap(bytes_, other.bytes_);
    std::swap(done_, other.done_);
    return *this;
  }
  ~MeteredRead() { TheInputBytes().done += bytes_ - done_; }

  // All but `left` bytes are gone through.
  void Left(uint64_t left) {
    if (bytes_ - left < done_ + kStep || left > bytes_) return;
    TheInputBytes().done += bytes_ - left - done_;
    done_ = bytes_ - left;
  }

 private:
  static constexpr uint64_t kStep = uint64_t{1} << 18;

  uint64_t bytes_ = 0, done_ = 0;
};

}  // namespace swell

#endif  // SWELL_IMPORT_READ_METER_H_
