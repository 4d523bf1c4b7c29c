// Points and numbers -> a light each, by the light tree or the alias table, for tests and
// benchmarks; and the probability with which a light is drawn.
#ifndef SWELL_KERNELS_CHOOSE_LIGHTS_H_
#define SWELL_KERNELS_CHOOSE_LIGHTS_H_

#include <cstddef>

#include "kernels/columns.h"
#include "kernels/kernel.h"
#include "kernels/records.h"
#include "kernels/scene_view.h"

namespace swell {

// Rows of points that look for a light. All columns are readable and writable up to the padding.
struct ChooseLightsArgs {
  const LightsView* lights;
  size_t count;
  Vec3Fields<In> point;
  Vec3Fields<In> normal;  // unit, to the side that light may come from; null x: from both
  const float* u;         // in [0, 1)
  uint32_t* light;        // drawn, or given
  float* pdf;             // written
};

// Draws a light for each point.
SWELL_KERNEL(void, ChooseLights, const ChooseLightsArgs& args);
// The probability with which ChooseLights draws the given light; does not read u.
SWELL_KERNEL(void, ChoicePdfs, const ChooseLightsArgs& args);

}  // namespace swell

#endif  // SWELL_KERNELS_CHOOSE_LIGHTS_H_
