// What the counters of a thread say, with hardware events or with the kernel's own.
#include "src/stats/perf_counters.h"

#include <doctest/doctest.h>
#include <linux/perf_event.h>

#include <time.h>

#include <cstdint>

namespace swell {
namespace {

// Nanoseconds of this thread, which every kernel counts where it lets processes count at all; the
// last is no event.
constexpr PerfEventCodes kSoftware = {{
    {PERF_TYPE_SOFTWARE, PERF_COUNT_SW_TASK_CLOCK},
    {PERF_TYPE_SOFTWARE, PERF_COUNT_SW_TASK_CLOCK},
    {PERF_TYPE_SOFTWARE, PERF_COUNT_SW_TASK_CLOCK},
    {PERF_TYPE_SOFTWARE, PERF_COUNT_SW_TASK_CLOCK},
    {PERF_TYPE_SOFTWARE, 1000},
}};

// Of this thread's time, however busy the machine is.
void WorkForMilliseconds(int64_t milliseconds) {
  const auto now = [] {
    timespec time;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return time.tv_sec * 1000 + time.tv_nsec / 1000000;
  };
  for (const int64_t start = now(); now() - start <= milliseconds;) continue;
}

}  // namespace

TEST_CASE("ScaledCount: is scaled to the whole time, and nothing if the counter never ran") {
  CHECK(ScaledCount({100, 10, 10}, {300, 50, 50}) == 200.0);
  CHECK(ScaledCount({100, 10, 10}, {300, 110, 60}) == 400.0);
  CHECK(ScaledCount({100, 10, 10}, {100, 20, 10}) == std::nullopt);
}

TEST_CASE("PerfCounts: a sum lacks what one of its parts lacks") {
  PerfCounts a{1.0, 2.0, std::nullopt, 4.0, std::nullopt}, b{10.0, std::nullopt, 30.0, 40.0};
  CHECK(a + b == PerfCounts{11.0, std::nullopt, std::nullopt, 44.0, std::nullopt});
}

TEST_CASE("PerfCounters: counts between Start and Stop only, and lacks unknown events") {
  PerfCounters counters(kSoftware);
  counters.Start();
  WorkForMilliseconds(5);
  const PerfCounts first = counters.Stop();
  WorkForMilliseconds(50);
  counters.Start();
  WorkForMilliseconds(5);
  const PerfCounts second = counters.Stop();
  CHECK(!first[4]);
  if (!first[0]) return;  // counting is forbidden here
  CHECK(*first[0] >= 4e6);
  CHECK(*second[0] >= 4e6);
  CHECK(*second[0] < 45e6);
}

TEST_CASE("PerfCounters: hardware events are counted, or lacking where the machine has none") {
  PerfCounters counters;
  counters.Start();
  WorkForMilliseconds(5);
  for (const std::optional<double>& count : counters.Stop()) {
    if (count) CHECK(*count > 0.0);
  }
}

}  // namespace swell
