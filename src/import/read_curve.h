// Parameters of curves, with pbrt-v4's names and defaults -> meshes of the scene.
#ifndef SWELL_IMPORT_READ_CURVE_H_
#define SWELL_IMPORT_READ_CURVE_H_

#include "src/import/parameters.h"
#include "src/import/shapes.h"

namespace swell {

void ReadCurve(Parameters& parameters, const Placement& placement, Scene* scene);

}  // namespace swell

#endif  // SWELL_IMPORT_READ_CURVE_H_
