// shadow rays -> paths: adds the light that nothing blocks.
#include "kernels/occlude_rays.h"

#include "src/stages/count_bounces.h"
#include "src/stages/holes.h"
#include "src/stages/media.h"
#include "src/stages/stages.h"
#include "src/stages/wave_recorder.h"

namespace swell {
namespace {

// Shadow rays by the bounce that sent them, which their paths know: through the window's rays.
BounceCounts CountShadowBounces(Wave& wave) {
  BounceCounts bounces{};
  for (const Window& window : wave.windows) {
    const RaysIn rays = wave.rays.ReadColumns(window.first);
    uint32_t* bounce_of_path = &wave.keys[window.first];  // the sort's scratch is free by now
    for (uint32_t i = 0; i < window.rays; ++i) {
      bounce_of_path[rays.path[i]] = rays.state[i] & kBounceMask;
    }
    const uint32_t* path = wave.shadow_rays.ReadColumns(window.first).path;
    AddBounces(
        window.shadow_rays, [&](uint32_t i) { return bounce_of_path[path[i]]; }, bounces);
  }
  return bounces;
}

}  // namespace

void OccludeStage(const RenderContext& context, Wave& wave, StageStats& stats) {
  if (context.scene.lights.count == 0) return;
  if (context.recorder != nullptr) context.recorder->Offer(Stage::kOcclude, wave);
  const BounceCounts bounces = CountShadowBounces(wave);
  StageTimer timer(context, stats, Stage::kOcclude, bounces);
  for (const Window& window : wave.windows) {
    if (window.shadow_rays == 0) continue;
    const bool holes = context.scene.textures.shape_alpha != nullptr;
    if (context.media != nullptr && !holes) {
      AbsorbShadowRays(context, wave, window, nullptr, window.shadow_rays);
    }
    const LaneUse use =
        holes ? OccludeWithHoles(context, wave, window)
              : OccludeRays(context.width, context.bvh, context.traversal,
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
