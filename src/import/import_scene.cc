// Chooses the reader of a scene by the ending of its files.
#include "src/import/import_scene.h"

#include <filesystem>

#include "src/import/diagnostics.h"
#include "src/import/gltf_reader.h"
#include "src/import/pbrt_reader.h"

namespace swell {

Result<Scene> ImportScene(const std::vector<std::string>& paths, const ImportOptions& options) {
  if (paths.empty()) return Error{"no scene file is given"};
  bool gltf = false;
  for (const std::string& path : paths) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) {
      return Error{path + ": is a directory, not a file"};
    }
    const std::string ending = std::filesystem::path(path).extension().string();
    const bool is_gltf = ending == ".gltf" || ending == ".glb";
    if (ending != ".pbrt" && !is_gltf) {
      return Error{path + ": unknown scene format " + Quote(ending) +
                   "; .pbrt, .gltf and .glb files are read"};
    }
    gltf = gltf || is_gltf;
  }
  if (gltf && paths.size() > 1) {
    return Error{paths[1] + ": only .pbrt files can be read together with others"};
  }
  if (gltf) return ReadGltf(paths[0], options);
  if (!options.camera.empty()) {
    return Error{paths[0] +
                 ": --camera chooses among the cameras of .gltf and .glb files; a .pbrt "
                 "scene has one"};
  }
  return ReadPbrt(paths);
}

}  // namespace swell
