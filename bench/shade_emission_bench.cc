// Measures ShadeEmission: recorded hits, few of them on lights.
#include "kernels/shade_emission.h"

#include <string>

#include "bench/cases.h"

namespace swell::bench {
namespace {

void Emission(benchmark::State& state, const WaveSource& source, Width width) {
  const RayWave& wave = RaysOf(source);
  Table<PathFields> paths(wave.rows);
  for (auto _ : state) {
    ShadeEmission(width, wave.scene->tables.view, wave.rays.ReadColumns(), wave.hits.ReadColumns(),
                  wave.rows, paths.Columns().radiance);
    benchmark::ClobberMemory();
  }
  ReportRows(state, width, wave.rows);
}

void Add(const WaveSource& source) {
  for (Width width : kWidths) {
    const std::string name = "ShadeEmission/" + source.label + "/" + NameOf(width);
    benchmark::RegisterBenchmark(name.c_str(), Emission, source, width);
  }
}
[[maybe_unused]] const bool kAdded = ForEachWave(WaveKind::kRays, Add);

}  // namespace
}  // namespace swell::bench
