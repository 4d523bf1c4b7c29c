// Scene, tables and BVH -> a film and its statistics: one task per worker, each with its own wave.
#include "src/schedule/render.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <limits>
#include <memory>
#include <thread>

#include "src/scene/views.h"
#include "src/schedule/ticker.h"
#include "src/stats/machine.h"
#include "src/stages/stages.h"
#include "src/stages/wave_recorder.h"
#include "src/wave/units.h"
#include "src/wave/wave.h"

namespace swell {
namespace {

using Clock = std::chrono::steady_clock;

double SecondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Waves of fewer rows than this are not timed stage by stage.
constexpr uint32_t kLeastTimedRows = 256;

struct Worker {
  Worker(uint32_t wave_rows, uint32_t window_rows, const SceneTables& tables)
      : wave(wave_rows, window_rows, tables.view.materials.count, tables.textures.column_count,
             tables.media.view.absorption != nullptr),
        stats(tables.view.materials.count) {}
  Wave wave;
  StageStats stats;
};

// Rows whose queues take about half of a core's L2 cache; the scene gets the other half. Measured
// on Cornell and glassroom, 2 MiB L2: 2048 to 8192 rows are equal within 2 %, 512 are 8 % slower,
// 65536 are 14 % slower.
uint32_t DefaultWaveRows() {
  constexpr size_t kRowBytes = 2 * Table<RayFields>::kRowBytes + Table<HitFields>::kRowBytes +
                               Table<ShadowRayFields>::kRowBytes + Table<PathFields>::kRowBytes +
                               4 * sizeof(uint32_t);
  const uint64_t l2_bytes = CoreL2Bytes().value_or(uint64_t{512} << 10);
  const uint64_t fit = l2_bytes / 2 / kRowBytes;
  return static_cast<uint32_t>(std::bit_floor(std::clamp<uint64_t>(fit * 9 / 8, 1024, 8192)));
}

}  // namespace

Result<RenderResult> Render(const Scene& scene, const SceneTables& tables, const Bvh& bvh,
                            const RenderOptions& options,
                            const std::function<void(const Progress&)>& progress) {
  // The file's limit is of exposed values; the film holds them before exposure.
  const float max_component = scene.request.max_component > 0.0f
                                  ? scene.request.max_component / scene.request.image_scale
                                  : std::numeric_limits<float>::infinity();
  Result<Film> film = Film::Make(options.width, options.height, options.crop, max_component);
  if (!film) return film.error();
  const uint32_t threads = options.thread_count != 0
                               ? options.thread_count
                               : std::max(1u, std::thread::hardware_concurrency());
  const uint32_t wave_rows = options.wave != 0 ? options.wave : DefaultWaveRows();
  const uint32_t window_rows =
      std::min(options.window != 0 ? options.window : wave_rows, wave_rows);
  const uint32_t material_count = tables.view.materials.count;

  std::vector<std::unique_ptr<Worker>> workers;
  for (uint32_t i = 0; i < threads; ++i) {
    workers.push_back(std::make_unique<Worker>(wave_rows, window_rows, tables));
    if (!workers.back()->wave.ok()) {
      return Error{"out of memory for a wave of " + std::to_string(wave_rows) +
                   " rows; use a smaller --wave or fewer --nthreads"};
    }
  }
  const FilterTables filter = MakeFilterTables(scene.request.filter);
  const BvhView bvh_view = bvh.view();
  std::unique_ptr<WaveRecorder> recorder;
  if (!options.dump.file.empty()) {
    recorder = std::make_unique<WaveRecorder>(options.dump.scene, options.dump.stage,
                                              options.dump.bounce, options.dump.rows);
  }
  const CameraView camera = MakeCameraView(scene.camera, options.width, options.height);
  const RenderContext context{
      tables.view,
      bvh_view,
      camera,
      filter.view(),
      MakePixelFootprint(camera),
      options.path,
      options.kernels,
      options.traversal,
      options.regenerate && recorder == nullptr,
      window_rows >= kLeastTimedRows,
      recorder.get(),
      tables.media.view.absorption != nullptr ? &tables.media.view : nullptr};
  Units units(options.crop, options.samples_per_pixel);
  const uint64_t total =
      uint64_t{options.crop.width()} * options.crop.height() * options.samples_per_pixel;
  const Clock::time_point start = Clock::now();
  {
    std::function<void()> report;
    if (progress) report = [&] { progress({film->samples_added(), total}); };
    const Ticker ticker(report);
    // One task per worker; oversubscription is the caller's wish.
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    std::max<size_t>(threads, 2));
    tbb::task_arena arena(static_cast<int>(threads));
    arena.execute([&] {
      tbb::task_group group;
      for (auto& worker : workers) {
        group.run([&] { TraceUnits(context, units, worker->wave, *film, worker->stats); });
      }
      group.wait();
    });
  }
  const double seconds = SecondsSince(start);
  if (recorder != nullptr) {
    const Status written = WriteWave(recorder->recorded(), options.dump.file);
    if (!written) return written.error();
  }
  RenderResult result{std::move(*film), StageStats(material_count)};
  for (const auto& worker : workers) result.stats.Merge(worker->stats);
  result.seconds = seconds;
  result.thread_count = threads;
  result.wave = workers.front()->wave.row_count();
  result.window = window_rows;
  result.wave_bytes = workers.front()->wave.bytes();
  result.stages_timed = context.timed;
  return result;
}

}  // namespace swell
