// perf_event_open in, counts of events out.
#include "src/stats/perf_counters.h"

#include <linux/perf_event.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace swell {
namespace {

constexpr uint64_t MissedLoads(uint64_t cache) {
  return cache | uint64_t{PERF_COUNT_HW_CACHE_OP_READ} << 8 |
         uint64_t{PERF_COUNT_HW_CACHE_RESULT_MISS} << 16;
}

int Open(const PerfEventCode& code) {
  perf_event_attr attributes{};
  attributes.size = sizeof(attributes);
  attributes.type = code.type;
  attributes.config = code.config;
  attributes.disabled = 1;
  attributes.exclude_kernel = 1;
  attributes.exclude_hv = 1;
  attributes.read_format = PERF_FORMAT_TOTAL_TIME_ENABLED | PERF_FORMAT_TOTAL_TIME_RUNNING;
  return static_cast<int>(syscall(SYS_perf_event_open, &attributes, /*pid=*/0, /*cpu=*/-1,
                                  /*group=*/-1, PERF_FLAG_FD_CLOEXEC));
}

bool Read(int file, PerfReading& reading) {
  return read(file, &reading, sizeof(reading)) == sizeof(reading);
}

}  // namespace

PerfEventCodes HardwareEventCodes() {
  return {{
      {PERF_TYPE_HARDWARE, PERF_COUNT_HW_CPU_CYCLES},
      {PERF_TYPE_HARDWARE, PERF_COUNT_HW_INSTRUCTIONS},
      {PERF_TYPE_HW_CACHE, MissedLoads(PERF_COUNT_HW_CACHE_L1D)},
      {PERF_TYPE_HW_CACHE, MissedLoads(PERF_COUNT_HW_CACHE_LL)},
      {PERF_TYPE_HARDWARE, PERF_COUNT_HW_BRANCH_MISSES},
  }};
}

std::optional<double> ScaledCount(const PerfReading& start, const PerfReading& stop) {
  const uint64_t running = stop.nanoseconds_running - start.nanoseconds_running;
  const uint64_t enabled = stop.nanoseconds_enabled - start.nanoseconds_enabled;
  if (running == 0) return std::nullopt;
  return static_cast<double>(stop.value - start.value) * static_cast<double>(enabled) /
         static_cast<double>(running);
}

PerfCounts operator+(const PerfCounts& a, const PerfCounts& b) {
  PerfCounts sum;
  for (uint32_t i = 0; i < kPerfEventCount; ++i) {
    if (a[i] && b[i]) sum[i] = *a[i] + *b[i];
  }
  return sum;
}

PerfCounters::PerfCounters(const PerfEventCodes& codes) {
  for (uint32_t i = 0; i < kPerfEventCount; ++i) files_[i] = Open(codes[i]);
}

PerfCounters::~PerfCounters() {
  for (int file : files_) {
    if (file >= 0) close(file);
  }
}

void PerfCounters::Start() {
  for (uint32_t i = 0; i < kPerfEventCount; ++i) {
    if (files_[i] < 0) continue;
    Read(files_[i], start_[i]);
    ioctl(files_[i], PERF_EVENT_IOC_ENABLE, 0);
  }
}

PerfCounts PerfCounters::Stop() {
  for (int file : files_) {
    if (file >= 0) ioctl(file, PERF_EVENT_IOC_DISABLE, 0);
  }
  PerfCounts counts;
  for (uint32_t i = 0; i < kPerfEventCount; ++i) {
    PerfReading stop;
    if (files_[i] >= 0 && Read(files_[i], stop)) counts[i] = ScaledCount(start_[i], stop);
  }
  return counts;
}

}  // namespace swell
