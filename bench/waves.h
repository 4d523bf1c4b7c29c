// Recorded waves as kernels take them: rows of real renders, in tables.
#ifndef SWELL_BENCH_WAVES_H_
#define SWELL_BENCH_WAVES_H_

#include <cstdint>
#include <string>
#include <vector>

#include "bench/record_wave.h"
#include "bench/scenes.h"
#include "kernels/records.h"
#include "src/stats/stats.h"
#include "src/wave/table.h"

namespace swell::bench {

// Where a wave comes from: recorded when it is first asked for, or read from a dump file.
struct WaveSource {
  std::string label;  // in the names of cases
  std::string scene;
  uint32_t bounce = 0;
  std::string file;  // of --dump-wave; "": record the scene
};

// Rays and their hits; row i extends path i.
struct RayWave {
  const BuiltScene* scene;
  uint32_t rows;
  Table<RayFields> rays;
  Table<HitFields> hits;
  Table<PathFields> paths;
};

// Row i is a question of path i.
struct ShadowWave {
  const BuiltScene* scene;
  uint32_t rows;
  Table<ShadowRayFields> shadow_rays;
  Table<PathFields> paths;
};

// Built and recorded once, kept for good. A wave that cannot be had ends the program with one line.
const BuiltScene& SceneOf(const std::string& name);
const RayWave& RaysOf(const WaveSource& source);
const ShadowWave& ShadowRaysOf(const WaveSource& source);

// The rows of a wave grouped by material, as SortHits leaves them.
struct SortedWave {
  std::vector<uint32_t> rows;
  std::vector<Run> runs;
};
SortedWave Sort(const RayWave& wave);

}  // namespace swell::bench

#endif  // SWELL_BENCH_WAVES_H_
