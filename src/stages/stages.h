// The stages of a wave. Each sizes queues, calls one kernel and records what it did.
#ifndef SWELL_STAGES_STAGES_H_
#define SWELL_STAGES_STAGES_H_

#include <chrono>
#include <cstdint>

#include "kernels/bvh_node.h"
#include "kernels/intersect_rays.h"
#include "kernels/media_view.h"
#include "kernels/scene_view.h"
#include "src/film/film.h"
#include "src/stats/stats.h"
#include "src/wave/units.h"
#include "src/wave/wave.h"

namespace swell {

class WaveRecorder;

// What all waves of a render share and none may change.
struct RenderContext {
  const SceneView& scene;
  const BvhView& bvh;
  CameraView camera;
  FilterView filter;
  PixelFootprint pixel;
  PathSettings settings;
  Width width;
  Traversal traversal;
  bool regenerate;
  bool timed;  // waves of a few rows are not timed: the clock would cost more than the stage
  WaveRecorder* recorder;  // null but for --dump-wave
  const MediaView* media;  // null: light is never in a medium
};

// Adds the time and the figures of one stage of one wave to the statistics when it goes out of
// scope.
class StageTimer {
 public:
  StageTimer(const RenderContext& context, StageStats& stats, Stage stage,
             const BounceCounts& bounces)
      : stats_(stats), stage_(stage), bounces_(bounces), timed_(context.timed) {
    if (timed_) start_ = std::chrono::steady_clock::now();
  }
  StageTimer(const StageTimer&) = delete;
  ~StageTimer() {
    if (timed_) row.nanoseconds = Nanoseconds();
    row.calls = 1;
    stats_.Record(stage_, bounces_, row);
  }

  uint64_t Nanoseconds() const {
    return static_cast<uint64_t>(std::chrono::duration_cast<std::chrono::nanoseconds>(
                                     std::chrono::steady_clock::now() - start_)
                                     .count());
  }

  // Rows that a row-by-row kernel handled, in whole vectors of `lanes`.
  void CountRows(size_t rows, size_t lanes, size_t bytes_read, size_t bytes_written) {
    row.rows += rows;
    row.lanes_active += rows;
    row.lanes_issued += (rows + lanes - 1) / lanes * lanes;
    row.bytes_read += rows * bytes_read;
    row.bytes_written += rows * bytes_written;
  }

  StageRow row;

 private:
  StageStats& stats_;
  Stage stage_;
  const BounceCounts& bounces_;
  bool timed_;
  std::chrono::steady_clock::time_point start_;
};

// Camera rays of a tile are coherent and stand together at the end of a window.
inline Traversal CameraTraversal(Traversal asked) {
  return asked == Traversal::kAuto ? Traversal::kPacket : asked;
}

// units -> rays, paths. False when nothing is left to do.
bool GenerateStage(const RenderContext& context, Units& units, UnitCursor& cursor, Wave& wave,
                   StageStats& stats);
// rays -> hits, row for row.
void IntersectStage(const RenderContext& context, Wave& wave, StageStats& stats);
// hits -> row ids and runs of one material.
void SortStage(const RenderContext& context, Wave& wave, StageStats& stats);
// hits on lights -> paths.
void ShadeEmissionStage(const RenderContext& context, Wave& wave, StageStats& stats);
// rays that left -> paths.
void ShadeMissStage(const RenderContext& context, Wave& wave, StageStats& stats);
// runs -> next, shadow rays.
void ShadeStage(const RenderContext& context, Wave& wave, StageStats& stats);
// The media that next and the shadow rays go on in; nothing in scenes without.
void EnterMediaStage(const RenderContext& context, Wave& wave);
// shadow rays -> paths.
void OccludeStage(const RenderContext& context, Wave& wave, StageStats& stats);
// next -> rays; the paths that ended are listed.
void CompactStage(const RenderContext& context, Wave& wave, StageStats& stats);
// ended paths -> film; their rows are free again.
void AccumulateStage(const RenderContext& context, Wave& wave, Film& film, StageStats& stats);

// Takes units until there are none left.
void TraceUnits(const RenderContext& context, Units& units, Wave& wave, Film& film,
                StageStats& stats);

}  // namespace swell

#endif  // SWELL_STAGES_STAGES_H_
