// What every stage did: calls, rows, lanes, time and bytes, by bounce and (for shading) by
// material. One StageStats per worker, merged at the end; fixed memory, no locks.
#ifndef SWELL_STATS_STATS_H_
#define SWELL_STATS_STATS_H_

#include <array>
#include <cstdint>
#include <vector>

#include "kernels/records.h"

namespace swell {

enum class Stage : uint32_t {
  kGenerate,
  kIntersect,
  kSort,
  kShadeMiss,
  kShadeEmission,
  kShade,
  kOcclude,
  kCompact,
  kAccumulate,
};
inline constexpr uint32_t kStageCount = 9;
inline constexpr const char* kStageNames[kStageCount] = {
    "generate", "intersect", "sort",    "shade_miss", "shade_emission",
    "shade",    "occlude",   "compact", "accumulate"};

// Bounces beyond the last are counted with it.
inline constexpr uint32_t kStatsBounces = 33;

struct StageRow {
  uint64_t calls = 0;
  uint64_t rows = 0;
  uint64_t lanes_active = 0;
  uint64_t lanes_issued = 0;
  uint64_t nanoseconds = 0;
  uint64_t bytes_read =
      0;  // of columns, by the records' layout; traversal and texture reads are not in it
  uint64_t bytes_written = 0;

  void Add(const StageRow& other) {
    calls += other.calls;
    rows += other.rows;
    lanes_active += other.lanes_active;
    lanes_issued += other.lanes_issued;
    nanoseconds += other.nanoseconds;
    bytes_read += other.bytes_read;
    bytes_written += other.bytes_written;
  }
};

// Rows of a queue by bounce.
using BounceCounts = std::array<uint32_t, kStatsBounces>;

class StageStats {
 public:
  explicit StageStats(uint32_t material_count) : shade_(material_count) {}

  // One call of `stage` over the rows counted in `bounces`: rows are exact; lanes, time and bytes
  // are shared out in proportion to rows. A call counts for every bounce it had rows of.
  void Record(Stage stage, const BounceCounts& bounces, const StageRow& call);
  void RecordShade(uint32_t material, const BounceCounts& bounces, const StageRow& call);
  void Merge(const StageStats& other);

  const StageRow& row(Stage stage, uint32_t bounce) const {
    return rows_[static_cast<uint32_t>(stage)][bounce];
  }
  const StageRow& shade_row(uint32_t material, uint32_t bounce) const {
    return shade_[material][bounce];
  }
  uint32_t material_count() const { return static_cast<uint32_t>(shade_.size()); }
  StageRow total(Stage stage) const;  // kShade: over all materials

  uint64_t paths = 0;
  uint64_t closest_rays = 0;
  uint64_t shadow_rays = 0;
  uint64_t non_finite_samples = 0;

 private:
  std::array<std::array<StageRow, kStatsBounces>, kStageCount> rows_{};
  std::vector<std::array<StageRow, kStatsBounces>> shade_;
};

}  // namespace swell

#endif  // SWELL_STATS_STATS_H_
