// Every queue of one worker. All memory exists before the first ray; stages change counts only.
#ifndef SWELL_WAVE_WAVE_H_
#define SWELL_WAVE_WAVE_H_

#include <cstdint>
#include <vector>

#include "kernels/records.h"
#include "src/base/result.h"
#include "src/stats/stats.h"
#include "src/wave/table.h"

namespace swell {

// Neighbouring rows that may regroup: sorting and compaction never cross a window's edge. It owns
// rows [first, first + capacity) of every table.
struct Window {
  uint32_t first = 0;
  uint32_t capacity = 0;
  uint32_t rays = 0;         // live rows of `rays`; the same rows of `hits`
  uint32_t fresh = 0;        // the last `fresh` of them are camera rays of this round
  uint32_t shadow_rays = 0;  // live rows of `shadow_rays`
  uint32_t free_slots = 0;   // unused rows of `paths`, listed in `slots`
  uint32_t ended = 0;        // paths that ended this round, listed in `ended`
  uint32_t runs = 0;         // runs of this round, in `runs` from run_first on
  uint32_t run_first = 0;
};

struct Wave {
  Wave(uint32_t row_count, uint32_t window_rows, uint32_t material_count,
       uint32_t texture_columns = 0, bool has_media = false);
  Wave(const Wave&) = delete;

  uint32_t row_count() const;  // rows that can carry a path
  bool ok() const;             // all memory could be had
  size_t bytes() const;

  std::vector<Window> windows;
  Table<RayFields> rays;  // this round's segments
  Table<RayFields> next;  // what shading makes of them, with ended rows in between
  Table<HitFields> hits;
  Table<ShadowRayFields> shadow_rays;
  Table<PathFields> paths;
  std::vector<uint32_t> rows;       // sorted row ids, relative to their window
  std::vector<uint32_t> keys;       // scratch of the sort
  std::vector<uint32_t> histogram;  // scratch of the sort: materials + 2
  std::vector<Run> runs;
  std::vector<uint32_t> slots;  // free rows of `paths`, relative to their window
  std::vector<uint32_t> ended;  // rows of `paths`, relative to their window
  BounceCounts bounces{};       // of all live rays
  // Parameters of one run's material that textures vary, column by column; scratch of shading.
  std::vector<float> texture_cells;
  size_t texture_stride;  // rows of a column
  // Only in scenes with media; the first is by row of `paths`, the second of `shadow_rays`.
  std::vector<uint32_t> path_medium, shadow_medium;
  std::vector<uint32_t> entered;  // media of rays that go on; scratch
};

}  // namespace swell

#endif  // SWELL_WAVE_WAVE_H_
