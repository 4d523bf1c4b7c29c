// Hardware counters of the calling thread, as far as the machine has them.
#ifndef SWELL_STATS_PERF_COUNTERS_H_
#define SWELL_STATS_PERF_COUNTERS_H_

#include <array>
#include <cstdint>
#include <optional>

namespace swell {

enum class PerfEvent : uint32_t {
  kCycles,
  kInstructions,
  kL1dMisses,     // loads that missed the first level
  kLlcMisses,     // loads that missed the last level
  kBranchMisses,  // mispredicted
};
inline constexpr uint32_t kPerfEventCount = 5;
inline constexpr const char* kPerfEventNames[kPerfEventCount] = {
    "cycles", "instructions", "l1d_misses", "llc_misses", "branch_misses"};

// What was counted; empty where the machine does not count it. In user code only. Where there are
// fewer counters than events the kernel takes turns, and counts are scaled up to the whole time.
using PerfCounts = std::array<std::optional<double>, kPerfEventCount>;

// Sums; an event that one of them lacks is lacking.
PerfCounts operator+(const PerfCounts& a, const PerfCounts& b);

// What perf_event_open calls an event.
struct PerfEventCode {
  uint32_t type;
  uint64_t config;
};
using PerfEventCodes = std::array<PerfEventCode, kPerfEventCount>;
PerfEventCodes HardwareEventCodes();

// One reading of a counter's file.
struct PerfReading {
  uint64_t value = 0, nanoseconds_enabled = 0, nanoseconds_running = 0;
};

// Scaled to the whole time it was wanted; empty if it never ran.
std::optional<double> ScaledCount(const PerfReading& start, const PerfReading& stop);

class PerfCounters {
 public:
  // Of the thread that makes it, and to be used by it only. Other codes are for tests.
  explicit PerfCounters(const PerfEventCodes& codes = HardwareEventCodes());
  PerfCounters(const PerfCounters&) = delete;
  PerfCounters& operator=(const PerfCounters&) = delete;
  ~PerfCounters();

  void Start();
  PerfCounts Stop();  // what was counted since Start

 private:
  std::array<int, kPerfEventCount> files_;  // -1: not counted here
  std::array<PerfReading, kPerfEventCount> start_;
};

}  // namespace swell

#endif  // SWELL_STATS_PERF_COUNTERS_H_
