// What rays lose on their way through media, and the media in which they go on. All of it is for
// scenes with media only.
#ifndef SWELL_STAGES_MEDIA_H_
#define SWELL_STAGES_MEDIA_H_

#include "src/stages/stages.h"

namespace swell {

// Takes from a window's rays what is absorbed up to their hits. Camera rays start in the camera's
// medium.
void AbsorbToHits(const RenderContext& context, Wave& wave, const Window& window);

// Rays that pass what they hit, in some table's rows.
struct PassingRays {
  Vec3Fields<In> org, dir;
  HitsIn hits;
  const uint32_t* through;  // the rows that pass
  size_t count;
  const uint32_t* row = nullptr;  // by row: of the wave's rays; null: it is that
};
// Changes the media of those that pass a border.
void CrossBorders(const RenderContext& context, Wave& wave, const Window& window,
                  const PassingRays& passing);

// Takes from the wave's rays `row` what is absorbed over `distance` more. Scratch: the throughput
// of `next`.
void AbsorbBehind(const RenderContext& context, Wave& wave, const Window& window,
                  const uint32_t* row, const float* distance, size_t count);

// Takes from the window's first `count` shadow rays what is absorbed up to their ends, or up to
// the distances `nearest` where these are less.
void AbsorbShadowRays(const RenderContext& context, Wave& wave, const Window& window,
                      const float* nearest, size_t count);

// Moves the media of the window's shadow rays to the front, as their rows, and changes those that
// pass a border.
void CrossShadowBorders(const RenderContext& context, Wave& wave, const Window& window,
                        const PassingRays& passing);

}  // namespace swell

#endif  // SWELL_STAGES_MEDIA_H_
