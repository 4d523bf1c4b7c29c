// rays -> hits, row for row.
#include "src/stages/holes.h"
#include "src/stages/media.h"
#include "src/stages/stages.h"
#include "src/stages/wave_recorder.h"

namespace swell {

void IntersectStage(const RenderContext& context, Wave& wave, StageStats& stats) {
  if (context.recorder != nullptr) context.recorder->Offer(Stage::kIntersect, wave);
  StageTimer timer(context, stats, Stage::kIntersect, wave.bounces);
  const auto trace = [&](Traversal traversal, uint32_t first, uint32_t count) {
    if (count == 0) return;
    const RaysIn rays = wave.rays.ReadColumns(first);
    const LaneUse use = IntersectRays(context.width, context.bvh, traversal, rays.org, rays.dir,
                                      wave.hits.Columns(first), count);
    timer.row.lanes_active += use.active;
    timer.row.lanes_issued += use.issued;
    timer.row.rows += count;
  };
  const Traversal camera = CameraTraversal(context.traversal);
  for (const Window& window : wave.windows) {
    const uint32_t bounced = window.rays - window.fresh;
    trace(context.traversal, window.first, bounced);
    trace(camera, window.first + bounced, window.fresh);
    if (context.media != nullptr) AbsorbToHits(context, wave, window);
    if (context.scene.textures.shape_alpha == nullptr) continue;
    const LaneUse use = IntersectBehindHoles(context, wave, window);
    timer.row.lanes_active += use.active;
    timer.row.lanes_issued += use.issued;
  }
  timer.row.bytes_read = timer.row.rows * sizeof(float) * 6;
  timer.row.bytes_written = timer.row.rows * Table<HitFields>::kRowBytes;
  stats.closest_rays += timer.row.rows;
}

}  // namespace swell
