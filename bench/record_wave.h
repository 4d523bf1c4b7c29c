// A scene, a stage and a bounce in, the rows that a real render of it sends there out.
#ifndef SWELL_BENCH_RECORD_WAVE_H_
#define SWELL_BENCH_RECORD_WAVE_H_

#include <cstdint>

#include "bench/scenes.h"
#include "src/base/result.h"
#include "src/stages/wave_recorder.h"

namespace swell::bench {

// Rows that a kernel gets at once: swell's default wave.
inline constexpr uint32_t kMostRows = 4096;

struct RecordOptions {
  Stage stage = Stage::kIntersect;
  uint32_t bounce = 0;
  uint32_t width = 512, height = 512;
  uint32_t samples_per_pixel = 1;
  uint32_t rows = 1u << 18;  // are enough; whole windows are taken
};

// In the order of the queues of one worker, the same on every call.
Result<RecordedWave> RecordWave(const BuiltScene& scene, const RecordOptions& options);

// What a render of the scene lets every path know.
PathSettings SettingsOf(const BuiltScene& scene);

}  // namespace swell::bench

#endif  // SWELL_BENCH_RECORD_WAVE_H_
