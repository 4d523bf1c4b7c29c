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
    std::filesystem::path name(path);
    if (name.extension() == ".gz") name.replace_extension();
    const std::string ending = name.extension().string();
    if (ending != ".pbrt") {
      return Error{path + ": unknown scene format " + Quote(ending) +
                   "; .pbrt files are read, and .pbrt.gz"};
    }
  }
  return ReadPbrt(paths);
}

}  // namespace swell
