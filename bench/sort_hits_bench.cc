// Measures SortHits: recorded hits to runs of one material.
#include "kernels/sort_hits.h"

#include <string>
#include <vector>

#include "bench/cases.h"

namespace swell::bench {
namespace {

void SortRows(benchmark::State& state, const WaveSource& source, Width width) {
  const RayWave& wave = RaysOf(source);
  const SceneView& scene = wave.scene->tables.view;
  std::vector<uint32_t> rows(wave.rays.capacity() + kRowPadding), keys(rows.size());
  std::vector<uint32_t> histogram(scene.materials.count + 2);
  std::vector<Run> runs(histogram.size());
  const SortHitsArgs args{&scene,
                          wave.scene->scene.request.max_depth,
                          wave.hits.ReadColumns().prim,
                          wave.rays.ReadColumns().state,
                          wave.rows,
                          keys.data(),
                          histogram.data(),
                          wave.rays.ReadColumns().dir,
                          wave.hits.ReadColumns().t,
                          wave.rays.ReadColumns().org};
  size_t run_count = 0;
  for (auto _ : state) {
    run_count = SortHits(width, args, rows.data(), runs.data());
    benchmark::ClobberMemory();
  }
  ReportRows(state, width, wave.rows);
  state.counters["runs"] = static_cast<double>(run_count);
}

void Add(const WaveSource& source) {
  for (Width width : kWidths) {
    const std::string name = "SortHits/" + source.label + "/" + NameOf(width);
    benchmark::RegisterBenchmark(name.c_str(), SortRows, source, width);
  }
}
[[maybe_unused]] const bool kAdded = ForEachWave(WaveKind::kRays, Add);

}  // namespace
}  // namespace swell::bench
