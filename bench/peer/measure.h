// Renders one scene with the peer and with swell's engines in alternation; what every repetition
// took, and whether the pictures agree.
#ifndef SWELL_BENCH_PEER_MEASURE_H_
#define SWELL_BENCH_PEER_MEASURE_H_

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/peer/error.h"
#include "bench/scenes.h"
#include "src/base/result.h"
#include "src/film/film.h"
#include "src/stats/stats.h"

namespace swell::bench {

struct MeasureOptions {
  uint32_t samples_per_pixel = 16;
  uint32_t repetitions = 10;
  uint32_t thread_count = 2;
  uint32_t wave = 0;                         // rows; 0: swell's default
  bool window_8 = true;                      // also swell --window 8
  bool megakernel = true;                    // also swell --engine megakernel
  std::optional<uint32_t> max_depth;         // instead of the scene's
  uint32_t true_samples = 0;                 // per pixel of the picture to compare with; 0: none
  std::vector<LightSampler> other_samplers;  // also swell with each of these
};

struct EngineFigures {
  std::string name;
  std::vector<double> seconds;       // of the tracing alone, by repetition
  std::vector<PictureError> errors;  // by repetition, if there is a true picture
  Image image;                       // of the last repetition
  StageStats stats{0};               // of all repetitions; empty for the peer
  // As swell's first engine, to the bit; nothing for the peer and for other light samplers.
  std::optional<bool> same_picture;
};

// The relative difference of the mean pixel, swell against the peer.
struct Agreement {
  double difference = 0;
  double noise = 0;  // standard error of the difference
};

struct SceneFigures {
  std::string scene;
  uint32_t thread_count = 0;
  uint64_t samples = 0;  // of one repetition
  uint32_t samples_per_pixel = 0;
  std::vector<EngineFigures> engines;  // the peer first
  Agreement agreement;
};

// Repetition i renders with seed i; the engines take turns, and each repetition starts with the
// next one.
Result<SceneFigures> Measure(const std::string& name, const BuiltScene& scene,
                             const MeasureOptions& options);

}  // namespace swell::bench

#endif  // SWELL_BENCH_PEER_MEASURE_H_
