// What a finished render tells: a table for people and the JSON contract for scripts.
#ifndef SWELL_STATS_REPORT_H_
#define SWELL_STATS_REPORT_H_

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "src/stats/machine.h"
#include "src/stats/stats.h"

namespace swell {

// The settings in effect, defaults included.
struct RunSettings {
  std::vector<std::string> scene_files;
  std::vector<std::string> outfiles;
  uint32_t width = 0, height = 0;         // of the full frame
  std::array<uint32_t, 4> crop_pixels{};  // x0 x1 y0 y1, of the full frame
  uint32_t samples_per_pixel = 0;
  uint32_t seed = 0;
  uint32_t max_depth = 0;
  uint32_t roulette_start = 0;
  uint32_t thread_count = 0;
  std::string engine;
  uint32_t wave = 0, window = 0;  // rows
  uint64_t wave_bytes = 0;        // queues of one worker
  std::string traversal;
  std::string isa;  // as asked for; Machine has what was used
  std::string diffuse_sampling;
  std::string sampler;
  std::string light_sampler;  // in effect
  bool regeneration = true;
};

// Wall-clock seconds of the phases; empty if one did not happen.
struct PhaseSeconds {
  std::optional<double> import_files, build, render, output;
};

struct RunReport {
  std::string scene;  // the first scene file
  RunSettings settings;
  Machine machine;
  PhaseSeconds seconds;
  std::optional<uint64_t> peak_rss_bytes;
  std::vector<std::string> material_labels;  // by material id
  const StageStats* stats = nullptr;         // must outlive the report
  bool stages_timed = true;                  // false: seconds of stages are not known
};

// The contract of design.md section 4, one line per stage row. Of a stage row:
//   seconds       time inside the stage, summed over all workers; null if stages were not timed
//   calls         a call counts for every bounce it had rows of
//   lanes_*, seconds, bytes_*  of a call that mixed bounces are shared out by rows
//   material      a label, or null for stages that do not know one
//   perf          hardware counters: null, not measured
// Bounce 32 stands for itself and all deeper ones. Rates are over the wall clock of the render.
// Numbers that could not be measured are null. One run: no repetitions, so no spread.
std::string StatsJson(const RunReport& report);

// Stages, shading by material, totals. Ends in a newline.
std::string SummaryTable(const RunReport& report);

// Every row with its bounce and material.
std::string StageTable(const RunReport& report);

// "1.23 GiB"
std::string FormatBytes(uint64_t bytes);
// "1,234,567"
std::string FormatCount(uint64_t count);

}  // namespace swell

#endif  // SWELL_STATS_REPORT_H_
