// Shapes that emit an image -> only those triangles that show some light of it.
#ifndef SWELL_IMPORT_DARK_EMITTERS_H_
#define SWELL_IMPORT_DARK_EMITTERS_H_

#include "src/scene/scene.h"

namespace swell {

// Triangles on which the image is black all over become a shape of their own, which does not emit:
// they would be lights that are drawn and give nothing. To be called once, on a finished scene.
void LeaveDarkUnlit(Scene* scene);

}  // namespace swell

#endif  // SWELL_IMPORT_DARK_EMITTERS_H_
