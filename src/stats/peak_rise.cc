// A function in, how much more memory was resident while it ran out.
#include "src/stats/peak_rise.h"

#include <fstream>
#include <string>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace swell {
namespace {

constexpr int64_t kNoise = 8 << 20;  // a mark that is set back may be this far above what is there

// A line of /proc/self/status such as "VmHWM:", in bytes.
std::optional<int64_t> StatusBytes(const std::string& key) {
  std::ifstream status("/proc/self/status");
  std::string word;
  int64_t kibibytes = 0;
  while (status >> word) {
    if (word == key && status >> kibibytes) return kibibytes * 1024;
  }
  return std::nullopt;
}

}  // namespace

std::optional<int64_t> PeakRise(const std::function<void()>& run) {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
  std::ofstream("/proc/self/clear_refs") << "5";  // the high-water mark starts from here
  const std::optional<int64_t> before = StatusBytes("VmRSS:"), mark = StatusBytes("VmHWM:");
  run();
  const std::optional<int64_t> after = StatusBytes("VmHWM:");
  if (!before || !mark || !after || *mark >= *before + kNoise) return std::nullopt;
  return *after - *before;
}

}  // namespace swell
