// next -> rays, without the rows whose paths ended.
#include "kernels/compact_columns.h"

#include "kernels/lane_count.h"
#include "src/stages/stages.h"

namespace swell {

void CompactStage(const RenderContext& context, Wave& wave, StageStats& stats) {
  StageTimer timer(context, stats, Stage::kCompact, wave.bounces);
  for (Window& window : wave.windows) {
    const auto from = wave.next.Words(window.first);
    const auto to = wave.rays.Words(window.first);
    const RaysIn next = wave.next.ReadColumns(window.first);
    const CompactArgs args{from.data(), to.data(), from.size(), window.rays,
                           next.state,  kEndedRay, next.path,   &wave.ended[window.first]};
    const uint32_t kept = static_cast<uint32_t>(CompactColumns(context.width, args));
    timer.CountRows(window.rays, LaneCount(context.width), Table<RayFields>::kRowBytes, 0);
    timer.row.bytes_written += kept * Table<RayFields>::kRowBytes;
    window.ended = window.rays - kept;
    window.rays = kept;
  }
}

}  // namespace swell
