// pbrt-v4 scene description files -> a Scene.
#ifndef SWELL_IMPORT_PBRT_READER_H_
#define SWELL_IMPORT_PBRT_READER_H_

#include <string>
#include <vector>

#include "src/base/result.h"
#include "src/scene/scene.h"

namespace swell {

inline constexpr size_t kMaxAttributeDepth = 4096;
inline constexpr uint32_t kMaxObjectDepth = 64;  // of objects within objects

Result<Scene> ReadPbrt(const std::vector<std::string>& paths);

}  // namespace swell

#endif  // SWELL_IMPORT_PBRT_READER_H_
