// Renders a scene: tiles and sample ranges go to workers, each with a wave of its own.
#ifndef SWELL_SCHEDULE_RENDER_H_
#define SWELL_SCHEDULE_RENDER_H_

#include <cstdint>
#include <functional>
#include <string>

#include "kernels/intersect_rays.h"
#include "kernels/kernel.h"
#include "src/base/result.h"
#include "src/bvh/bvh.h"
#include "src/film/film.h"
#include "src/scene/scene.h"
#include "src/stats/stats.h"

namespace swell {

// Asks for the rows that enter `stage` at `bounce` to be written to `file`, once ("" : none).
struct WaveDump {
  Stage stage = Stage::kIntersect;
  uint32_t bounce = 0;
  std::string file;
  std::string scene;         // path to note in the file
  uint32_t rows = 1u << 18;  // are enough
};

// Everything that the command line and the scene file together decide.
struct RenderOptions {
  uint32_t width = 0, height = 0;
  PixelBounds crop;
  uint32_t samples_per_pixel = 16;
  uint32_t thread_count = 0;  // 0: all cores
  PathSettings path{};
  Width kernels = Width::kWide;  // kOneLane: --engine megakernel
  uint32_t wave = 0;             // rows; 0: to fit the core's L2 cache
  uint32_t window = 0;           // rows; 0: the wave
  bool regenerate = true;        // refill ended rows from the next unit
  Traversal traversal = Traversal::kAuto;
  WaveDump dump;
};

struct Progress {
  uint64_t samples_done = 0;
  uint64_t samples_total = 0;
};

struct RenderResult {
  Film film;
  StageStats stats;
  double seconds = 0;
  uint32_t thread_count = 0;      // in effect
  uint32_t wave = 0, window = 0;  // in effect
  size_t wave_bytes = 0;          // queues of one worker
  bool stages_timed = true;       // false: waves so small that a clock would cost more than a stage
};

// `progress` is called now and then from one thread at a time. An error only where memory does not
// suffice or the dump cannot be written.
Result<RenderResult> Render(const Scene& scene, const SceneTables& tables, const Bvh& bvh,
                            const RenderOptions& options,
                            const std::function<void(const Progress&)>& progress);

}  // namespace swell

#endif  // SWELL_SCHEDULE_RENDER_H_
