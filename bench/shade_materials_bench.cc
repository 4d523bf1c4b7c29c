// Measures the shading kernel of every material on the rows of a wave that have it.
#include <string>

#include "bench/cases.h"
#include "bench/shading.h"
#include "kernels/lane_count.h"
#include "kernels/material.h"

namespace swell::bench {
namespace {

void Shade(benchmark::State& state, const WaveSource& source, uint32_t kind, Width width) {
  const RayWave& wave = RaysOf(source);
  const SortedWave sorted = Sort(wave);
  const PathSettings settings = SettingsOf(*wave.scene);
  Shaded shaded(wave.rows);
  const size_t lanes = LaneCount(width);
  LaneUse use;
  for (const Run& run : sorted.runs) {
    if (KindOf(wave, run) != kind) continue;
    use.active += run.count;
    use.issued += (run.count + lanes - 1) / lanes * lanes;
  }
  if (use.active == 0) {
    state.SkipWithError("the wave has no row of this material");
    return;
  }
  for (auto _ : state) {
    shaded.shadow_count = 0;
    for (const Run& run : sorted.runs) {
      if (KindOf(wave, run) == kind) ShadeRun(width, wave, sorted, run, settings, shaded);
    }
    benchmark::ClobberMemory();
  }
  Report(state, use.active, use);
}

void Add(const WaveSource& source) {
  const bool all_diffuse = source.scene == "cornell";
  for (uint32_t kind = 0; kind < kMaterialKindCount; ++kind) {
    const std::string material = kMaterialKinds[kind]->name;
    if (all_diffuse && material != "diffuse") continue;
    for (Width width : kWidths) {
      const std::string name = "Shade/" + source.label + "/" + material + "/" + NameOf(width);
      benchmark::RegisterBenchmark(name.c_str(), Shade, source, kind, width);
    }
  }
}
[[maybe_unused]] const bool kAdded = ForEachWave(WaveKind::kRays, Add);

}  // namespace
}  // namespace swell::bench
