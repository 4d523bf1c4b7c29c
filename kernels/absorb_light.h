// Light, media and distances in; what is left of the light out.
#ifndef SWELL_KERNELS_ABSORB_LIGHT_H_
#define SWELL_KERNELS_ABSORB_LIGHT_H_

#include "kernels/kernel.h"
#include "kernels/media_view.h"
#include "kernels/records.h"

namespace swell {

struct AbsorbLightArgs {
  const float* absorption;  // of MediaView
  const uint32_t* medium;   // of row i, or of path[i] where there is `path`
  const uint32_t* path;     // null: media are row for row
  const float* distance;    // in units of dir
  const float* nearest;     // where it is less than the distance, this counts; may be null
  Vec3Fields<In> dir;       // null: of unit length
  size_t count;
  RgbFields<Out> light;  // is multiplied by the transmittance, exp(-absorption * distance)
};

// Infinite distances leave nothing but what is not absorbed at all. Works on whole vectors: rows up
// to a multiple of kRowPadding are scratch, but media and paths must be valid in [0, count) only.
SWELL_KERNEL(void, AbsorbLight, const AbsorbLightArgs& args);

}  // namespace swell

#endif  // SWELL_KERNELS_ABSORB_LIGHT_H_
