// Files in a folder that is removed at the end of a test, and scenes read from them.
#ifndef SWELL_TESTS_IMPORT_SCRATCH_FILES_H_
#define SWELL_TESTS_IMPORT_SCRATCH_FILES_H_

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include <doctest/doctest.h>

#include "src/import/import_scene.h"

namespace swell::test {

class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "swell-test-XXXXXX").string();
    REQUIRE(mkdtemp(name.data()) != nullptr);
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;

  std::string Path(const std::string& name) const { return (path_ / name).string(); }
  std::string Write(const std::string& name, std::string_view bytes) const {
    const std::filesystem::path path = path_ / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << bytes;
    return path.string();
  }

 private:
  std::filesystem::path path_;
};

inline Result<Scene> ReadText(std::string_view text) {
  const ScratchFolder folder;
  return ImportScene({folder.Write("scene.pbrt", text)});
}

// The scene of a text that must be good.
inline Scene SceneOf(std::string_view text) {
  Result<Scene> scene = ReadText(text);
  INFO(text);
  INFO((scene ? "" : scene.error().message));
  REQUIRE(scene);
  return std::move(*scene);
}

// The scene of what stands behind WorldBegin.
inline Scene WorldOf(std::string_view text) { return SceneOf("WorldBegin\n" + std::string(text)); }

// Whether one of the scene's warnings holds `fragment`.
inline bool Warns(const Scene& scene, std::string_view fragment) {
  for (const std::string& warning : scene.warnings) {
    if (warning.find(fragment) != std::string::npos) return true;
  }
  return false;
}

}  // namespace swell::test

#endif  // SWELL_TESTS_IMPORT_SCRATCH_FILES_H_
