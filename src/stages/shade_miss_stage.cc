// rays that left the scene -> paths.
#include "kernels/shade_miss.h"

#include "kernels/lane_count.h"
#include "kernels/sort_hits.h"
#include "src/stages/count_bounces.h"
#include "src/stages/stages.h"

namespace swell {

void ShadeMissStage(const RenderContext& context, Wave& wave, StageStats& stats) {
  if (context.scene.lights.infinite_count == 0) return;
  BounceCounts bounces{};
  StageTimer timer(context, stats, Stage::kShadeMiss, bounces);
  for (const Window& window : wave.windows) {
    for (uint32_t r = 0; r < window.runs; ++r) {
      const Run& run = wave.runs[window.run_first + r];
      if (run.material != kMissRun) continue;
      ShadeMiss(context.width, context.scene, wave.rays.ReadColumns(window.first),
                &wave.rows[window.first + run.first], run.count,
                wave.paths.Columns(window.first).radiance);
      AddRunBounces(wave, window, run, bounces);
      timer.CountRows(run.count, LaneCount(context.width), sizeof(float) * 9, sizeof(float) * 3);
    }
  }
}

}  // namespace swell
