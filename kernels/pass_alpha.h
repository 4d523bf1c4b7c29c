// Hits of surfaces with holes in; the rays that pass through them out.
#ifndef SWELL_KERNELS_PASS_ALPHA_H_
#define SWELL_KERNELS_PASS_ALPHA_H_

#include "kernels/kernel.h"
#include "kernels/records.h"
#include "kernels/scene_view.h"

namespace swell {

struct PassAlphaArgs {
  const SceneView* scene;
  PixelFootprint pixel;
  Vec3Fields<In> org, dir;
  HitsIn hits;         // row for row
  const float* t_max;  // hits from here on do not matter; null: all do
  size_t count;
  uint32_t* SWELL_RESTRICT through;  // the rows that pass, in their order
  Vec3Fields<Out> origin;            // of the k-th of them: where it goes on
  float* SWELL_RESTRICT moved;       // and how far that is, in units of dir
};

// A ray passes a surface of opacity a with probability 1 - a, by a number hashed from its origin
// and direction. Returns how many pass; up to a vector of rows behind them is scratch.
SWELL_KERNEL(size_t, PassAlpha, const PassAlphaArgs& args);

}  // namespace swell

#endif  // SWELL_KERNELS_PASS_ALPHA_H_
