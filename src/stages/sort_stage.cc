// hits -> row ids and runs of one material, window by window.
#include "kernels/sort_hits.h"

#include "kernels/lane_count.h"
#include "src/stages/stages.h"

namespace swell {

void SortStage(const RenderContext& context, Wave& wave, StageStats& stats) {
  StageTimer timer(context, stats, Stage::kSort, wave.bounces);
  uint32_t run_first = 0;
  for (Window& window : wave.windows) {
    const SortHitsArgs args{&context.scene,
                            context.settings.max_depth,
                            wave.hits.ReadColumns(window.first).prim,
                            wave.rays.ReadColumns(window.first).state,
                            window.rays,
                            &wave.keys[window.first],
                            wave.histogram.data(),
                            wave.rays.ReadColumns(window.first).dir,
                            wave.hits.ReadColumns(window.first).t,
                            wave.rays.ReadColumns(window.first).org,
                            wave.hits.ReadColumns(window.first).u,
                            wave.hits.ReadColumns(window.first).v,
                            wave.hits.ReadColumns(window.first).instance,
                            context.pixel};
    window.run_first = run_first;
    window.runs = static_cast<uint32_t>(
        SortHits(context.width, args, &wave.rows[window.first], &wave.runs[run_first]));
    run_first += window.runs;
    timer.CountRows(window.rays, LaneCount(context.width), 2 * sizeof(uint32_t),
                    2 * sizeof(uint32_t));
  }
}

}  // namespace swell
