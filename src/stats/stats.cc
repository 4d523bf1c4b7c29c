// Shares the figures of a stage's call out over bounces, and adds workers up.
#include "src/stats/stats.h"

namespace swell {
namespace {

void Share(std::array<StageRow, kStatsBounces>& rows, const BounceCounts& bounces,
           const StageRow& call) {
  uint64_t total = 0;
  for (uint32_t count : bounces) total += count;
  if (total == 0) return;
  // Cumulative shares, so that the parts add up to the whole to the last unit.
  uint64_t before = 0;
  for (uint32_t b = 0; b < kStatsBounces; ++b) {
    if (bounces[b] == 0) continue;
    const uint64_t after = before + bounces[b];
    const auto share = [&](uint64_t whole) {
      return static_cast<uint64_t>(static_cast<unsigned __int128>(whole) * after / total -
                                   static_cast<unsigned __int128>(whole) * before / total);
    };
    rows[b].Add({call.calls, bounces[b], share(call.lanes_active), share(call.lanes_issued),
                 share(call.nanoseconds), share(call.bytes_read), share(call.bytes_written)});
    before = after;
  }
}

}  // namespace

void StageStats::Record(Stage stage, const BounceCounts& bounces, const StageRow& call) {
  Share(rows_[static_cast<uint32_t>(stage)], bounces, call);
}

void StageStats::RecordShade(uint32_t material, const BounceCounts& bounces, const StageRow& call) {
  Share(shade_[material], bounces, call);
}

void StageStats::Merge(const StageStats& other) {
  for (uint32_t s = 0; s < kStageCount; ++s) {
    for (uint32_t b = 0; b < kStatsBounces; ++b) rows_[s][b].Add(other.rows_[s][b]);
  }
  for (size_t m = 0; m < shade_.size(); ++m) {
    for (uint32_t b = 0; b < kStatsBounces; ++b) shade_[m][b].Add(other.shade_[m][b]);
  }
  paths += other.paths;
  closest_rays += other.closest_rays;
  shadow_rays += other.shadow_rays;
  non_finite_samples += other.non_finite_samples;
}

StageRow StageStats::total(Stage stage) const {
  StageRow sum;
  for (const StageRow& row : rows_[static_cast<uint32_t>(stage)]) sum.Add(row);
  if (stage == Stage::kShade) {
    for (const auto& bounces : shade_) {
      for (const StageRow& row : bounces) sum.Add(row);
    }
  }
  return sum;
}

}  // namespace swell
