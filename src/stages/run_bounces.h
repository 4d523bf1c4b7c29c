// Counts the rows of a run by bounce, for the statistics.
#ifndef SWELL_STAGES_RUN_BOUNCES_H_
#define SWELL_STAGES_RUN_BOUNCES_H_

#include <algorithm>

#include "src/wave/wave.h"

namespace swell {

inline void AddRunBounces(const Wave& wave, const Window& window, const Run& run,
                          BounceCounts& bounces) {
  const uint32_t* states = wave.rays.ReadColumns(window.first).state;
  const uint32_t* rows = &wave.rows[window.first + run.first];
  for (uint32_t i = 0; i < run.count; ++i) {
    ++bounces[std::min(states[rows[i]] & kBounceMask, kStatsBounces - 1)];
  }
}

}  // namespace swell

#endif  // SWELL_STAGES_RUN_BOUNCES_H_
