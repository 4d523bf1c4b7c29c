// A bare PLY file -> a scene of one mesh of grey clay, framed and lit.
#ifndef SWELL_IMPORT_PLY_SCENE_H_
#define SWELL_IMPORT_PLY_SCENE_H_

#include <string>

#include "src/base/result.h"
#include "src/scene/scene.h"

namespace swell {

Result<Scene> ReadPlyScene(const std::string& path);

}  // namespace swell

#endif  // SWELL_IMPORT_PLY_SCENE_H_
