// Rays through surfaces with holes: what traversal found is asked for its opacity, and the rays
// that pass are traced on.
#ifndef SWELL_STAGES_HOLES_H_
#define SWELL_STAGES_HOLES_H_

#include "src/stages/stages.h"

namespace swell {

// Replaces the hits of a window's rays that pass a surface by what they hit next. Scratch: `next`,
// `shadow_rays`, `rows`.
LaneUse IntersectBehindHoles(const RenderContext& context, Wave& wave, const Window& window);

// As OccludeRays, for scenes with such surfaces. Scratch: `rays`, `hits`, `rows`; the window's
// shadow rays are used up.
LaneUse OccludeWithHoles(const RenderContext& context, Wave& wave, const Window& window);

}  // namespace swell

#endif  // SWELL_STAGES_HOLES_H_
