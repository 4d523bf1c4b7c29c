// Chooses the reader of a scene by the ending of its files.
#include "src/import/import_scene.h"

#include <filesystem>

#include "src/import/diagnostics.h"
#include "src/import/pbrt_reader.h"

namespace swell {

Result<Scene> ImportScene(const std::vector<std::string>& paths) {
  if (paths.empty()) return Error{"no scene file is given"};
  for (const std::string& path : paths) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) {
      return Error{path + ": is a directory, not a file"};
    }
    const std::string ending = std::filesystem::path(path).extension().string();
    if (ending != ".pbrt") {
      return Error{path + ": unknown scene format " + Quote(ending) + "; .pbrt files are read"};
    }
  }
  return ReadPbrt(paths);
}

}  // namespace swell
