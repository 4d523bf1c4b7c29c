// Measures CompactColumns: the rows that shading left, without those whose paths ended.
#include "kernels/compact_columns.h"

#include <string>
#include <vector>

#include "bench/cases.h"
#include "bench/shading.h"
#include "kernels/material.h"

namespace swell::bench {
namespace {

// Shades all runs; rows without a material end.
void ShadeWave(const RayWave& wave, Shaded& shaded) {
  const SortedWave sorted = Sort(wave);
  const RaysIn rays = wave.rays.ReadColumns();
  for (const Run& run : sorted.runs) {
    if (KindOf(wave, run) != kMaterialKindCount) {
      ShadeRun(Width::kWide, wave, sorted, run, SettingsOf(*wave.scene), shaded);
      continue;
    }
    const RaysOut next = shaded.next.Columns(run.first);
    for (uint32_t i = 0; i < run.count; ++i) {
      next.path[i] = rays.path[sorted.rows[run.first + i]];
      next.state[i] = kEndedRay;
    }
  }
}

void Compact(benchmark::State& state, const WaveSource& source, Width width) {
  const RayWave& wave = RaysOf(source);
  Shaded shaded(wave.rows);
  ShadeWave(wave, shaded);
  Table<RayFields> kept(wave.rows);
  std::vector<uint32_t> ended(kept.capacity() + kRowPadding);
  const auto from = shaded.next.Words();
  const auto to = kept.Words();
  const RaysIn next = shaded.next.ReadColumns();
  const CompactArgs args{from.data(), to.data(), from.size(), wave.rows,
                         next.state,  kEndedRay, next.path,   ended.data()};
  size_t kept_rows = 0;
  for (auto _ : state) {
    kept_rows = CompactColumns(width, args);
    benchmark::ClobberMemory();
  }
  ReportRows(state, width, wave.rows);
  state.counters["kept"] = static_cast<double>(kept_rows) / wave.rows;
  state.SetBytesProcessed(state.iterations() *
                          static_cast<int64_t>(wave.rows * Table<RayFields>::kRowBytes));
}

void Add(const WaveSource& source) {
  for (Width width : kWidths) {
    const std::string name = "CompactColumns/" + source.label + "/" + NameOf(width);
    benchmark::RegisterBenchmark(name.c_str(), Compact, source, width);
  }
}
[[maybe_unused]] const bool kAdded = ForEachWave(WaveKind::kRays, Add);

}  // namespace
}  // namespace swell::bench
