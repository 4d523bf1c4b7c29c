// shadow rays -> paths: adds the light that nothing blocks.
#include "kernels/occlude_rays.h"

#include "src/stages/stages.h"
#include "src/stages/wave_recorder.h"

namespace swell {

void OccludeStage(const RenderContext& context, Wave& wave, StageStats& stats) {
  if (context.scene.lights.count == 0) return;
  if (context.recorder != nullptr) context.recorder->Offer(Stage::kOcclude, wave);
  StageTimer timer(context, stats, Stage::kOcclude, wave.bounces);
  for (const Window& window : wave.windows) {
    if (window.shadow_rays == 0) continue;
    const LaneUse use = OccludeRays(context.width, context.bvh, context.traversal,
                                    wave.shadow_rays.ReadColumns(window.first),
                                    wave.paths.Columns(window.first).radiance, window.shadow_rays);
    timer.row.rows += window.shadow_rays;
    timer.row.lanes_active += use.active;
    timer.row.lanes_issued += use.issued;
  }
  timer.row.bytes_read = timer.row.rows * Table<ShadowRayFields>::kRowBytes;
  timer.row.bytes_written = timer.row.rows * sizeof(float) * 3;
  stats.shadow_rays += timer.row.rows;
}

}  // namespace swell
