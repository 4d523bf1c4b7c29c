// An OBJ file with its MTL files -> a scene, framed and lit.
#ifndef SWELL_IMPORT_OBJ_H_
#define SWELL_IMPORT_OBJ_H_

#include <string>

#include "src/base/result.h"
#include "src/scene/scene.h"

namespace swell {

Result<Scene> ReadObj(const std::string& path);

}  // namespace swell

#endif  // SWELL_IMPORT_OBJ_H_
