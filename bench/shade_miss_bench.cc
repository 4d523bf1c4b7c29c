// Measures ShadeMiss: the rows of a recorded wave that left the scene.
#include "kernels/shade_miss.h"

#include <string>

#include "bench/cases.h"
#include "kernels/sort_hits.h"

namespace swell::bench {
namespace {

void Miss(benchmark::State& state, const WaveSource& source, Width width) {
  const RayWave& wave = RaysOf(source);
  const SortedWave sorted = Sort(wave);
  Run escaped{};
  for (const Run& run : sorted.runs) {
    if (run.material == kMissRun) escaped = run;
  }
  if (escaped.count == 0) {
    state.SkipWithError("no ray of the wave left the scene");
    return;
  }
  Table<PathFields> paths(wave.rows);
  for (auto _ : state) {
    ShadeMiss(width, wave.scene->tables.view, wave.rays.ReadColumns(), &sorted.rows[escaped.first],
              escaped.count, paths.Columns().radiance);
    benchmark::ClobberMemory();
  }
  ReportRows(state, width, escaped.count);
}

void Add(const WaveSource& source) {
  for (Width width : kWidths) {
    const std::string name = "ShadeMiss/" + source.label + "/" + NameOf(width);
    benchmark::RegisterBenchmark(name.c_str(), Miss, source, width);
  }
}
[[maybe_unused]] const bool kAdded = ForEachWave(WaveKind::kEscapedRays, Add);

}  // namespace
}  // namespace swell::bench
