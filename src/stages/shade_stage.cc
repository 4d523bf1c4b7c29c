// runs of one material -> next, shadow rays.
#include <algorithm>

#include "kernels/lane_count.h"
#include "kernels/material.h"
#include "kernels/sort_hits.h"
#include "src/stages/count_bounces.h"
#include "src/stages/stages.h"
#include "src/stages/wave_recorder.h"

namespace swell {
namespace {

constexpr size_t kBytesRead = Table<RayFields>::kRowBytes + Table<HitFields>::kRowBytes +
                              2 * sizeof(uint32_t) + sizeof(uint32_t);

// Paths of a run that scatters no more: they end where they are.
void EndRun(Wave& wave, const Window& window, const Run& run) {
  const RaysIn rays = wave.rays.ReadColumns(window.first);
  const RaysOut next = wave.next.Columns(window.first + run.first);
  const uint32_t* rows = &wave.rows[window.first + run.first];
  for (uint32_t i = 0; i < run.count; ++i) {
    next.path[i] = rays.path[rows[i]];
    next.state[i] = kEndedRay;
  }
}

void ShadeRun(const RenderContext& context, Wave& wave, Window& window, const Run& run) {
  const MaterialsView& materials = context.scene.materials;
  const ShadeArgs args{&context.scene,
                       context.settings,
                       materials.params + size_t{run.material} * kMaterialWords,
                       &wave.rows[window.first + run.first],
                       run.count,
                       wave.rays.ReadColumns(window.first),
                       wave.hits.ReadColumns(window.first),
                       wave.paths.ReadColumns(window.first),
                       wave.next.Columns(window.first + run.first),
                       wave.shadow_rays.Columns(window.first),
                       window.shadow_rays};
  const MaterialInfo& kind = *kMaterialKinds[materials.kind[run.material]];
  window.shadow_rays = static_cast<uint32_t>(kind.shade(context.width, args));
}

}  // namespace

void ShadeStage(const RenderContext& context, Wave& wave, StageStats& stats) {
  if (context.recorder != nullptr) context.recorder->Offer(Stage::kShade, wave);
  const uint32_t lanes = LaneCount(context.width);
  for (Window& window : wave.windows) {
    window.shadow_rays = 0;
    // In this order: a run's last vector spills into the rows of the next run, which come after it.
    for (uint32_t r = 0; r < window.runs; ++r) {
      const Run& run = wave.runs[window.run_first + r];
      if (run.material >= kMissRun) {
        EndRun(wave, window, run);
        continue;
      }
      BounceCounts bounces{};
      AddRunBounces(wave, window, run, bounces);
      const uint32_t shadow_before = window.shadow_rays;
      const auto start = context.timed ? std::chrono::steady_clock::now()
                                       : std::chrono::steady_clock::time_point();
      ShadeRun(context, wave, window, run);
      StageRow row{.calls = 1, .rows = run.count, .lanes_active = run.count};
      row.lanes_issued = (run.count + lanes - 1) / lanes * lanes;
      row.bytes_read = run.count * kBytesRead;
      row.bytes_written = run.count * Table<RayFields>::kRowBytes +
                          (window.shadow_rays - shadow_before) * Table<ShadowRayFields>::kRowBytes;
      if (context.timed) {
        const auto elapsed = std::chrono::steady_clock::now() - start;
        row.nanoseconds = static_cast<uint64_t>(
            std::chrono::duration_cast<std::chrono::nanoseconds>(elapsed).count());
      }
      stats.RecordShade(run.material, bounces, row);
    }
  }
}

}  // namespace swell
