// hits on lights -> paths.
#include "kernels/shade_emission.h"

#include "kernels/lane_count.h"
#include "src/stages/stages.h"

namespace swell {

void ShadeEmissionStage(const RenderContext& context, Wave& wave, StageStats& stats) {
  if (!context.scene.lights.any_area) return;
  StageTimer timer(context, stats, Stage::kShadeEmission, wave.bounces);
  for (const Window& window : wave.windows) {
    if (window.rays == 0) continue;
    ShadeEmission(context.width, context.scene, wave.rays.ReadColumns(window.first),
                  wave.hits.ReadColumns(window.first), window.rays,
                  wave.paths.Columns(window.first).radiance);
    timer.CountRows(window.rays, LaneCount(context.width), sizeof(uint32_t), 0);
  }
}

}  // namespace swell
