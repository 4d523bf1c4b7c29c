// Chooses the reader of a scene by the ending of its files.
#include "src/import/import_scene.h"

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "src/base/suggest.h"
#include "src/base/text.h"
#include "src/import/dark_emitters.h"
#include "src/import/diagnostics.h"
#include "src/import/gltf_reader.h"
#include "src/import/obj.h"
#include "src/import/pbrt_reader.h"
#include "src/import/ply_scene.h"

namespace swell {

namespace {

// In lower case: "model.OBJ" is one too. That of what is packed, where that may be.
std::string EndingOf(const std::string& path) {
  const std::filesystem::path name(path);
  std::string ending = name.extension().string();
  if (ending == ".gz") {
    const std::string packed = name.stem().extension().string();
    if (packed == ".pbrt" || packed == ".ply") ending = packed;
  }
  return LowerCase(ending);
}

Result<Scene> Lit(Result<Scene> scene) {
  if (scene) LeaveDarkUnlit(&*scene);
  return scene;
}

struct Format {
  std::string_view ending;
  // Null: several files are read as one, by ReadPbrt.
  Result<Scene> (*read)(const std::string& path, const ImportOptions& options);
  bool has_cameras = false;  // to choose among
};
constexpr Format kFormats[] = {
    {".glb", ReadGltf, true},
    {".gltf", ReadGltf, true},
    {".obj", [](const std::string& path, const ImportOptions&) { return Lit(ReadObj(path)); }},
    {".pbrt", nullptr},
    {".ply", [](const std::string& path, const ImportOptions&) { return ReadPlyScene(path); }},
};

const Format* FindFormat(std::string_view ending) {
  const auto found = std::find_if(std::begin(kFormats), std::end(kFormats),
                                  [&](const Format& format) { return format.ending == ending; });
  return found == std::end(kFormats) ? nullptr : found;
}

Result<Scene> Read(const std::vector<std::string>& paths, const ImportOptions& options) {
  if (paths.empty()) return Error{"no scene file is given"};
  for (const std::string& path : paths) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) {
      return Error{path + ": is a directory, not a file"};
    }
    const std::string ending = EndingOf(path);
    const Format* format = FindFormat(ending);
    if (format == nullptr) {
      std::vector<std::string_view> endings;
      for (const Format& known : kFormats) endings.push_back(known.ending);
      return Error{path + ": unknown scene format " + Quote(ending) + "; " + ListOf(endings) +
                   " files are read, .pbrt and .ply also packed as .gz"};
    }
    if (format->read != nullptr && paths.size() > 1) {
      return Error{path + ": only .pbrt files can be read together; give this one alone"};
    }
    if (!options.camera.empty() && !format->has_cameras) {
      return Error{path +
                   ": --camera chooses among the cameras of .gltf and .glb files; others have one"};
    }
    if (format->read != nullptr) return format->read(path, options);
  }
  return Lit(ReadPbrt(paths));
}

}  // namespace

Result<Scene> ImportScene(const std::vector<std::string>& paths, const ImportOptions& options) {
  return Read(paths, options);
}

}  // namespace swell
