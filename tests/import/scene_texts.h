// Scenes read from texts, which stand in a temporary folder meanwhile.
#ifndef SWELL_TESTS_IMPORT_SCENE_TEXTS_H_
#define SWELL_TESTS_IMPORT_SCENE_TEXTS_H_

#include <string>
#include <string_view>

#include <doctest/doctest.h>

#include "src/import/import_scene.h"
#include "tests/support/temporary_folder.h"

namespace swell::test {

inline Result<Scene> ReadText(std::string_view text) {
  const TemporaryFolder folder;
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

#endif  // SWELL_TESTS_IMPORT_SCENE_TEXTS_H_
