// glTF 2.0 files (.gltf, .glb) -> a Scene.
#ifndef SWELL_IMPORT_GLTF_READER_H_
#define SWELL_IMPORT_GLTF_READER_H_

#include <string>

#include "src/import/import_scene.h"

namespace swell {

// What the file lacks of a picture, a camera or lights, is added: see frame_scene.h.
Result<Scene> ReadGltf(const std::string& path, const ImportOptions& options);

}  // namespace swell

#endif  // SWELL_IMPORT_GLTF_READER_H_
