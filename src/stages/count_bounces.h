// Counts rows by bounce, for the statistics.
#ifndef SWELL_STAGES_COUNT_BOUNCES_H_
#define SWELL_STAGES_COUNT_BOUNCES_H_

#include <algorithm>

#include "src/wave/wave.h"

namespace swell {

// Adds the bounces of `count` rows, given as bounce(i), to `bounces`. Neighbours are mostly of one
// bounce, and a counter can only be raised every few cycles, so long queues use four of each.
template <class Bounce>
void AddBounces(uint32_t count, const Bounce& bounce, BounceCounts& bounces) {
  constexpr uint32_t kParts = 4;
  const auto bucket = [&](uint32_t i) { return std::min(bounce(i), kStatsBounces - 1); };
  uint32_t i = 0;
  if (count >= 64 * kParts) {
    std::array<BounceCounts, kParts> parts{};
    for (; i + kParts <= count; i += kParts) {
      for (uint32_t p = 0; p < kParts; ++p) ++parts[p][bucket(i + p)];
    }
    for (const BounceCounts& part : parts) {
      for (uint32_t b = 0; b < kStatsBounces; ++b) bounces[b] += part[b];
    }
  }
  for (; i < count; ++i) ++bounces[bucket(i)];
}

inline void AddRayBounces(const Wave& wave, const Window& window, BounceCounts& bounces) {
  const uint32_t* states = wave.rays.ReadColumns(window.first).state;
  AddBounces(
      window.rays, [&](uint32_t i) { return states[i] & kBounceMask; }, bounces);
}

inline void AddRunBounces(const Wave& wave, const Window& window, const Run& run,
                          BounceCounts& bounces) {
  const uint32_t* states = wave.rays.ReadColumns(window.first).state;
  const uint32_t* rows = &wave.rows[window.first + run.first];
  AddBounces(
      run.count, [&](uint32_t i) { return states[rows[i]] & kBounceMask; }, bounces);
}

}  // namespace swell

#endif  // SWELL_STAGES_COUNT_BOUNCES_H_
