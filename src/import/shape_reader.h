// Shape directives -> shapes of the scene's parts.
#ifndef SWELL_IMPORT_SHAPE_READER_H_
#define SWELL_IMPORT_SHAPE_READER_H_

#include <string>

#include "src/import/parameters.h"
#include "src/import/scene_parts.h"
#include "src/import/shapes.h"

namespace swell {

// Files of meshes are read by other threads.
void ReadShape(Parameters& parameters, const std::string& type, const Placement& placement,
               SceneParts* parts);

}  // namespace swell

#endif  // SWELL_IMPORT_SHAPE_READER_H_
