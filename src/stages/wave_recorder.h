// Copies of the rows that enter a stage, for benchmarks on real waves (--dump-wave).
#ifndef SWELL_STAGES_WAVE_RECORDER_H_
#define SWELL_STAGES_WAVE_RECORDER_H_

#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "src/base/result.h"
#include "src/stats/stats.h"
#include "src/wave/wave.h"

namespace swell {

// Columns of one record by name, as 32-bit words.
struct RecordedColumn {
  std::string name;
  std::vector<uint32_t> words;
};

// What a dump file holds. Rays and hits share rows; shadow rays have their own.
struct RecordedWave {
  std::string scene;  // path of the scene file it was recorded from
  Stage stage = Stage::kIntersect;
  uint32_t bounce = 0;
  uint32_t rows = 0;
  std::vector<RecordedColumn> columns;  // `rows` words each
};

// Collects rows of one stage and bounce from all workers until it has enough.
class WaveRecorder {
 public:
  WaveRecorder(std::string scene, Stage stage, uint32_t bounce, uint32_t enough);

  // Called by the stages; takes rows if they are of the stage and bounce wanted. Thread-safe. The
  // wave must not regenerate, so that all its rows are of one bounce.
  void Offer(Stage stage, const Wave& wave);

  const RecordedWave& recorded() const { return recorded_; }

 private:
  void TakeRays(const Wave& wave, const Window& window);
  void TakeShadowRays(const Wave& wave, const Window& window);

  uint32_t enough_;  // rows; it takes whole windows, so a few more
  std::mutex mutex_;
  RecordedWave recorded_;
};

// A text header, then the raw columns in the machine's byte order. Whole or not at all.
Status WriteWave(const RecordedWave& wave, const std::string& path);
Result<RecordedWave> ReadWave(const std::string& path);

}  // namespace swell

#endif  // SWELL_STAGES_WAVE_RECORDER_H_
