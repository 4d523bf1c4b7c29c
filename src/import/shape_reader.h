// Shape directives -> shapes of the scene.
#ifndef SWELL_IMPORT_SHAPE_READER_H_
#define SWELL_IMPORT_SHAPE_READER_H_

#include <string>

#include "src/import/parameters.h"
#include "src/import/shapes.h"

namespace swell {

void ReadShape(Parameters& parameters, const std::string& type, const Placement& placement,
               Scene* scene);

}  // namespace swell

#endif  // SWELL_IMPORT_SHAPE_READER_H_
