// How a benchmark names its cases: a function for each recorded wave, called before the first run.
#ifndef SWELL_BENCH_CASES_H_
#define SWELL_BENCH_CASES_H_

#include <benchmark/benchmark.h>

#include <cstdint>
#include <string>

#include "bench/waves.h"
#include "kernels/kernel.h"
#include "kernels/records.h"

namespace swell::bench {

// What a source of waves is good for.
enum class WaveKind { kRays, kShadowRays, kEscapedRays };

// Registers the cases of one wave: calls benchmark::RegisterBenchmark.
using AddCases = void (*)(const WaveSource& source);

// For a static variable of a benchmark's source: `add` is called for every wave of the kind, and
// for the file of --wave.
bool ForEachWave(WaveKind kind, AddCases add);

inline constexpr Width kWidths[] = {Width::kWide, Width::kOneLane};
inline const char* NameOf(Width width) { return width == Width::kWide ? "wide" : "one_lane"; }

// Rows per second, and the share of lanes that carried a row (or node, or primitive).
inline void Report(benchmark::State& state, size_t rows, const LaneUse& use) {
  state.SetItemsProcessed(state.iterations() * static_cast<int64_t>(rows));
  state.counters["rows"] = static_cast<double>(rows);
  state.counters["lanes_a_row"] = static_cast<double>(use.issued) / static_cast<double>(rows);
  state.counters["lanes"] =
      use.issued == 0 ? 0.0 : static_cast<double>(use.active) / static_cast<double>(use.issued);
}
// Of a kernel that takes rows in whole vectors.
void ReportRows(benchmark::State& state, Width width, size_t rows);

}  // namespace swell::bench

#endif  // SWELL_BENCH_CASES_H_
