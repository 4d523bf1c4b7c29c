// Measures the shading kernels: on the rows of a wave that have the material, and of every
// registered material on all hits of one wave, full vectors against one lane.
#include <algorithm>
#include <array>
#include <chrono>
#include <string>
#include <string_view>
#include <vector>

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
using Params = std::array<float, kMaterialWords>;

// The defaults, with all that is called a roughness at the given value if that is not negative.
Params ParamsOf(const MaterialInfo& info, float roughness) {
  Params params{};
  for (uint32_t i = 0; i < info.param_count; ++i) {
    const ParamSpec& spec = info.params[i];
    float* words = &params[ParamOffset(info, i)];
    std::copy_n(spec.fallback, spec.type == ParamType::kRgb ? 3 : 1, words);
    const bool is_roughness = std::string_view(spec.name).find("roughness") != std::string::npos;
    if (is_roughness && spec.type == ParamType::kFloat && roughness >= 0) *words = roughness;
  }
  return params;
}

// The rows that hit something, in the order of their paths.
std::vector<uint32_t> HitRows(const RayWave& wave) {
  std::vector<uint32_t> rows;
  for (uint32_t i = 0; i < wave.rows; ++i) {
    if (wave.hits.ReadColumns().prim[i] != kNoPrim) rows.push_back(i);
  }
  return rows;
}

double Seconds(std::chrono::steady_clock::duration time) {
  return std::chrono::duration<double>(time).count();
}

// Both widths by turns, so that a busy machine slows both. The rate is that of full vectors;
// `gain`, the median over the turns, is theirs over that of one lane.
void ShadeByTurns(benchmark::State& state, const WaveSource& source, uint32_t kind,
                  const Params& params) {
  const RayWave& wave = RaysOf(source);
  const PathSettings settings = SettingsOf(*wave.scene);
  std::vector<uint32_t> rows = HitRows(wave);
  const size_t count = rows.size(), lanes = LaneCount(Width::kWide);
  rows.resize(RoundUpToPadding(count) + kRowPadding, rows.front());
  Shaded shaded(wave.rows);
  const auto shade = [&](Width width) {
    const auto start = std::chrono::steady_clock::now();
    shaded.shadow_count = 0;
    ShadeAs(width, wave, kind, params.data(), rows.data(), count, 0, settings, shaded);
    benchmark::ClobberMemory();
    return Seconds(std::chrono::steady_clock::now() - start);
  };
  std::vector<double> gains, one_lane_seconds;
  for (auto _ : state) {
    const double wide = shade(Width::kWide), one_lane = shade(Width::kOneLane);
    state.SetIterationTime(wide);
    one_lane_seconds.push_back(one_lane);
    gains.push_back(one_lane / wide);
  }
  const auto median = [](std::vector<double>& of) {
    std::nth_element(of.begin(), of.begin() + static_cast<ptrdiff_t>(of.size() / 2), of.end());
    return of[of.size() / 2];
  };
  Report(state, count, {count, (count + lanes - 1) / lanes * lanes});
  state.counters["one_lane_per_second"] = static_cast<double>(count) / median(one_lane_seconds);
  state.counters["gain"] = median(gains);
}

void AddEveryMaterial(const WaveSource& source) {
  if (source.label != "room_bounce1" && source.file.empty()) return;
  for (uint32_t kind = 0; kind < kMaterialKindCount; ++kind) {
    const MaterialInfo& info = *kMaterialKinds[kind];
    const auto add = [&](const std::string& label, const Params& params) {
      const std::string name = "ShadeEvery/" + source.label + "/" + info.name + label;
      benchmark::RegisterBenchmark(name.c_str(), ShadeByTurns, source, kind, params)
          ->UseManualTime();
    };
    const Params defaults = ParamsOf(info, -1), smooth = ParamsOf(info, 0);
    const Params rough = ParamsOf(info, 0.3f);
    if (smooth == rough) {
      add("", defaults);
    } else {
      add("/smooth", smooth);
      add("/rough", rough);
    }
  }
}
[[maybe_unused]] const bool kAddedEvery = ForEachWave(WaveKind::kRays, AddEveryMaterial);
[[maybe_unused]] const bool kAdded = ForEachWave(WaveKind::kRays, Add);

}  // namespace
}  // namespace swell::bench
