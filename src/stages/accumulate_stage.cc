// ended paths -> film; their rows of `paths` are free again.
#include "kernels/accumulate_film.h"

#include <algorithm>

#include "src/stages/stages.h"

namespace swell {

void AccumulateStage(const RenderContext& context, Wave& wave, Film& film, StageStats& stats) {
  BounceCounts ended{};
  StageTimer timer(context, stats, Stage::kAccumulate, ended);
  for (Window& window : wave.windows) {
    if (window.ended == 0) continue;
    const uint32_t* paths = &wave.ended[window.first];
    stats.non_finite_samples += film.Add(wave.paths.ReadColumns(window.first), paths, window.ended);
    std::copy_n(paths, window.ended, &wave.slots[window.first + window.free_slots]);
    window.free_slots += window.ended;
    ended[0] += window.ended;  // a path as a whole: the row of its first bounce
    timer.CountRows(window.ended, 1, Table<PathFields>::kRowBytes, sizeof(FilmPixel));
    window.ended = 0;
  }
}

}  // namespace swell
