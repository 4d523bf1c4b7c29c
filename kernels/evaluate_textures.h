// Hits in, the parameters that textures give their material out.
#ifndef SWELL_KERNELS_EVALUATE_TEXTURES_H_
#define SWELL_KERNELS_EVALUATE_TEXTURES_H_

#include "kernels/kernel.h"
#include "kernels/records.h"
#include "kernels/scene_view.h"

namespace swell {

struct EvaluateTexturesArgs {
  const SceneView* scene;
  uint32_t program;  // row of TexturesView::programs
  PixelFootprint pixel;
  const uint32_t* rows;  // `count` rows of rays and hits; readable up to the padding
  size_t count;
  RaysIn rays;
  HitsIn hits;
  float* const* columns;    // by word: row i is for rows[i]; not null where the program writes
  Vec3Fields<Out> normals;  // likewise, for programs with a bump or a normal map
};

// Writes rows [0, count) of the program's words and normals, and their padding.
SWELL_KERNEL(void, EvaluateTextures, const EvaluateTexturesArgs& args);

}  // namespace swell

#endif  // SWELL_KERNELS_EVALUATE_TEXTURES_H_
