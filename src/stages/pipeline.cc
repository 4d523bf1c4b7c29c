// One wave, from camera to film: the order of the stages.
#include "src/stages/stages.h"

namespace swell {

void TraceUnits(const RenderContext& context, Units& units, Wave& wave, Film& film,
                StageStats& stats) {
  UnitCursor cursor;
  while (GenerateStage(context, units, cursor, wave, stats)) {  // refills the rows of ended paths
    IntersectStage(context, wave, stats);
    SortStage(context, wave, stats);  // row ids only: one run per material
    ShadeEmissionStage(context, wave, stats);
    ShadeMissStage(context, wave, stats);
    ShadeStage(context, wave, stats);  // fills shadow_rays and next
    EnterMediaStage(context, wave);    // does nothing in scenes without media
    OccludeStage(context, wave, stats);
    CompactStage(context, wave, stats);  // next -> rays, without the paths that ended
    AccumulateStage(context, wave, film, stats);
  }
}

}  // namespace swell
