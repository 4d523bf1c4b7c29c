// Measures AccumulateFilm: a wave of ended paths onto the pixels they came from.
#include "kernels/accumulate_film.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "bench/cases.h"

namespace swell::bench {
namespace {

void Accumulate(benchmark::State& state, const WaveSource& source) {
  const RayWave& wave = RaysOf(source);
  const RenderRequest& request = wave.scene->scene.request;
  Table<PathFields> paths(wave.rows);
  const auto from = wave.paths.Words();
  const auto to = paths.Words();
  for (size_t c = 0; c < from.size(); ++c) std::copy_n(from[c], wave.rows, to[c]);
  const RgbFields<In> throughput = wave.rays.ReadColumns().throughput;
  std::copy_n(throughput.r, wave.rows, paths.Columns().radiance.r);
  std::copy_n(throughput.g, wave.rows, paths.Columns().radiance.g);
  std::copy_n(throughput.b, wave.rows, paths.Columns().radiance.b);
  std::vector<uint32_t> rows(wave.rows);
  std::iota(rows.begin(), rows.end(), 0u);
  std::vector<FilmPixel> pixels(size_t{request.width} * request.height);
  const FilmView film{pixels.data(), 0, 0, request.width, std::numeric_limits<float>::infinity()};
  for (auto _ : state) {
    benchmark::DoNotOptimize(AccumulateFilm(paths.ReadColumns(), rows.data(), rows.size(), film));
    benchmark::ClobberMemory();
  }
  ReportRows(state, Width::kOneLane, rows.size());
}

void Add(const WaveSource& source) {
  const std::string name = "AccumulateFilm/" + source.label;
  benchmark::RegisterBenchmark(name.c_str(), Accumulate, source);
}
[[maybe_unused]] const bool kAdded = ForEachWave(WaveKind::kRays, Add);

}  // namespace
}  // namespace swell::bench
