// Scene files -> a Scene, or one line that says what is wrong and where.
#ifndef SWELL_IMPORT_IMPORT_SCENE_H_
#define SWELL_IMPORT_IMPORT_SCENE_H_

#include <string>
#include <vector>

#include "src/base/result.h"
#include "src/scene/scene.h"

namespace swell {

struct ImportOptions {
  std::string camera;  // name or index, of formats whose files may have several; "": the first
};

// Reads a scene file; the format is chosen by its ending (.pbrt, .gltf, .glb, .obj, .ply). Several
// .pbrt files are read as one, in order, as pbrt does.
Result<Scene> ImportScene(const std::vector<std::string>& paths, const ImportOptions& options = {});

}  // namespace swell

#endif  // SWELL_IMPORT_IMPORT_SCENE_H_
